#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/row_file.h>

#include <algorithm>
#include <filesystem>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    /// numbers kept in memory before they go to the file
    constexpr std::size_t largest_buffer = 1 << 20;
  } // namespace

  RowFile::RowFile(const std::string &stem, const std::vector<std::string> &columns)
      : stem(stem), columns(columns)
  {
  }

  void RowFile::add(const std::vector<double> &row)
  {
    buffer.insert(buffer.end(), row.begin(), row.end());
    if (buffer.size() >= largest_buffer)
      flush();
  }

  void RowFile::flush()
  {
    if (buffer.empty())
      return;
    // rows behind those that a checkpoint counts go only now, when it has been read to its end
    std::error_code error;
    if (!file.is_open() && n_written > 0)
      fs::resize_file(stem + ".rows", n_written * columns.size() * sizeof(double), error);
    if (!file.is_open() && !error)
      file.open(stem + ".rows", std::ios::binary | (n_written > 0 ? std::ios::app : std::ios::trunc));
    file.write(reinterpret_cast<const char *>(buffer.data()), buffer.size() * sizeof(double));
    file.flush();
    if (!file)
      throw OutputError("the file \"" + stem +
                        ".rows\" cannot be written; give a folder with write permission and free space");
    n_written = size();
    buffer.clear();
  }

  void RowFile::resume(const unsigned long n)
  {
    const std::uintmax_t n_bytes = n * columns.size() * sizeof(double);
    std::error_code error;
    if (n == 0)
      return; // nothing had been flushed yet
    if (fs::file_size(stem + ".rows", error) >= n_bytes && !error)
    {
      n_written = n;
      return;
    }
    // a run that came to its end has the columns only
    if (fs::exists(stem + ".h5"))
    {
      Hdf5Reader earlier(stem + ".h5");
      buffer.resize(n * columns.size());
      bool complete = true;
      for (unsigned int k = 0; k < columns.size() && complete; ++k)
      {
        const std::vector<double> values = earlier.numbers(columns[k]);
        complete = values.size() >= n;
        for (unsigned long i = 0; i < n && complete; ++i)
          buffer[i * columns.size() + k] = values[i];
      }
      if (complete)
        return;
    }
    throw InputError("The checkpoint counts " + std::to_string(n) + " lines in \"" + stem +
                     ".rows\", but they are gone: run the file without --resume.");
  }

  std::vector<double> RowFile::column(const unsigned int k) const
  {
    const std::size_t width = columns.size();
    std::vector<double> values;
    values.reserve(size());
    std::ifstream rows;
    if (n_written > 0)
      rows.open(stem + ".rows", std::ios::binary);
    std::vector<double> block(width * std::max<std::size_t>(1, largest_buffer / width));
    for (unsigned long left = n_written * width; left > 0;)
    {
      const std::size_t n = std::min<unsigned long>(left, block.size());
      if (!rows.read(reinterpret_cast<char *>(block.data()), n * sizeof(double)))
        throw OutputError("the file \"" + stem + ".rows\" was changed during the run; run again");
      for (std::size_t i = k; i < n; i += width)
        values.push_back(block[i]);
      left -= n;
    }
    for (std::size_t i = k; i < buffer.size(); i += width)
      values.push_back(buffer[i]);
    return values;
  }

  void RowFile::finish(const bool at_the_end)
  {
    if (!at_the_end)
      flush();
    Hdf5Writer columns_file(stem + ".h5");
    for (unsigned int k = 0; k < columns.size(); ++k)
      columns_file.write(columns[k], column(k));
    columns_file.finish();
    if (!at_the_end)
      return;
    file.close();
    std::error_code ignored;
    fs::remove(stem + ".rows", ignored);
  }
} // namespace vibrocontact
