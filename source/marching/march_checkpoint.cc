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
    void read_whole(const std::string &name, const std::string &advice, const Read &read)
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
        throw InputError("The checkpoint \"" + name + "\" is damaged or incomplete" + advice);
      }
    }
  } // namespace

  MarchCheckpoint::MarchCheckpoint(const std::string &file_name, const std::string &section, const int format,
                                   const std::string &advice)
      : name(file_name), section(section), format(format), advice(": " + advice + ".")
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
    read_whole(name, advice,
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
                       "in another format than that of " + version() + advice);
    return reader;
  }

  void MarchCheckpoint::check_end_time(const double end_time, const double time_step) const
  {
    const auto reader = opened();
    double time = 0;
    if (reader)
      read_whole(name, advice, [&] { time = reader->number("time"); });
    if (time <= end_time * (1 + 1e-12) + rounding_of_times * time_step)
      return;
    std::ostringstream text;
    text << section << "/End time = " << end_time << " s is before what the run to be resumed has reached, "
         << time << " s: give a later one.";
    throw InputError(text.str());
  }

  bool MarchCheckpoint::read_part(const Marks &marks,
                                  const std::function<void(CheckpointFile &, double)> &exchange) const
  {
    const auto reader = opened();
    if (!reader)
      return false;
    for (const auto &[mark, values] : marks)
    {
      std::vector<double> written;
      read_whole(name, advice, [&, &mark = mark] { written = reader->numbers("marks/" + mark); });
      if (differ(written, values))
        throw InputError("The checkpoint \"" + name + "\" belongs to other bodies, their " + mark +
                         " differ; a parameter, a mesh, a section or the program has changed" + advice);
    }
    CheckpointFile file(*reader);
    read_whole(name, advice, [&] { exchange(file, reader->number("time")); });
    return true;
  }

  bool MarchCheckpoint::read(March &march, const Recorders &recorders) const
  {
    return read_part(march.marks(),
                     [&](CheckpointFile &file, const double time)
                     {
                       march.exchange(file);
                       for (Recorder *const recorder : recorders)
                         recorder->exchange(file);
                       if (!(march.time() == time))
                         throw InputError("The march stands at another time than its checkpoint.");
                     });
  }
} // namespace vibrocontact
