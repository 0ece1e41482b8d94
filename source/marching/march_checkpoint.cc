#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/marching/march_checkpoint.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    constexpr auto run_without_resume = ": run the file without --resume.";

    /// Relative to the number itself, or to the largest of its kind where it is a small one: modes that were
    /// computed again, on another number of ranks, are the same but for round-off.
    bool differ(const std::vector<double> &a, const std::vector<double> &b)
    {
      if (a.size() != b.size())
        return true;
      double largest = 0;
      for (const double value : a)
        largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= 1e-5 * std::abs(a[i]) + 1e-7 * largest))
          return true;
      return false;
    }

    /// Whatever `read` stumbles over in the checkpoint of this name becomes one sentence; RowsLost and OutputError say their own.
    template <typename Read>
    void read_whole(const std::string &name, const Read &read)
    {
      try
      {
        read();
      }
      catch (const RowsLost &)
      {
        throw;
      }
      catch (const OutputError &)
      {
        throw;
      }
      catch (const std::exception &)
      {
        throw InputError("The checkpoint \"" + name + "\" is damaged or incomplete" + run_without_resume);
      }
    }
  } // namespace

  MarchCheckpoint::MarchCheckpoint(const std::string &file_name, const std::string &section, const int format)
      : name(file_name), section(section), format(format)
  {
  }

  void MarchCheckpoint::write(March &march, const Recorders &recorders) const
  {
    Hdf5Writer writer(name);
    writer.write("format", format);
    writer.write("program", version());
    writer.write("time", march.time());
    for (const auto &[mark, values] : march.marks())
      writer.write("marks/" + mark, values);
    CheckpointFile file(writer);
    march.exchange(file);
    for (Recorder *const recorder : recorders)
      recorder->exchange(file);
    writer.finish(true);
  }

  std::unique_ptr<Hdf5Reader> MarchCheckpoint::opened() const
  {
    if (!std::filesystem::exists(name))
      return nullptr;
    std::unique_ptr<Hdf5Reader> reader;
    int written_format = 0;
    read_whole(name,
               [&]
               {
                 // sizes and places are used as they are read
                 Hdf5Reader::check_seal(name);
                 reader = std::make_unique<Hdf5Reader>(name);
                 written_format = reader->integer("format");
               });
    if (written_format != format)
      throw InputError("The checkpoint \"" + name + "\" was written " +
                       (reader->has("program") ? "by version " + reader->text("program") + " " : "") +
                       "in another format than that of " + version() + run_without_resume);
    return reader;
  }

  void MarchCheckpoint::check_end_time(const double end_time, const double slack) const
  {
    const auto reader = opened();
    double reached = 0;
    if (reader)
      read_whole(name, [&] { reached = reader->number("time"); });
    if (reached <= end_time * (1 + 1e-12) + slack)
      return;
    std::ostringstream text;
    text << section << "/End time = " << end_time << " s is before what the run to be resumed has reached, "
         << reached << " s: give a later one.";
    throw InputError(text.str());
  }

  bool MarchCheckpoint::read(March &march, const Recorders &recorders) const
  {
    const auto reader = opened();
    if (!reader)
      return false;
    check_end_time(march.end_time());
    for (const auto &[mark, values] : march.marks())
    {
      std::vector<double> written;
      read_whole(name, [&, &mark = mark] { written = reader->numbers("marks/" + mark); });
      if (differ(written, values))
        throw InputError("The checkpoint \"" + name + "\" belongs to other bodies, their " + mark +
                         " differ though the parameters are the same; a mesh, a section or the program has "
                         "changed" +
                         run_without_resume);
    }
    CheckpointFile file(*reader);
    read_whole(name,
               [&]
               {
                 march.exchange(file);
                 for (Recorder *const recorder : recorders)
                   recorder->exchange(file);
                 if (!(march.time() == reader->number("time")))
                   throw InputError("The march stands at another time than its checkpoint.");
               });
    return true;
  }
} // namespace vibrocontact
