#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/base/table.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  namespace
  {
    /// numbers kept in memory before they go to the file
    constexpr std::size_t largest_buffer = 1 << 20;

    std::uint64_t sum_of_block(const std::uint64_t before, const std::uint64_t n_rows,
                               const std::vector<double> &data)
    {
      Checksum sum(before);
      sum.add(&n_rows, sizeof n_rows);
      sum.add(data);
      return sum.value();
    }
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
    if (!file.is_open() && written.rows > 0)
      fs::resize_file(stem + ".rows", written.bytes, error);
    if (!file.is_open() && !error)
      file.open(stem + ".rows", std::ios::binary | (written.rows > 0 ? std::ios::app : std::ios::trunc));
    const std::uint64_t n_rows = buffer.size() / columns.size(),
                        head[] = {n_rows, sum_of_block(written.sum, n_rows, buffer)};
    file.write(reinterpret_cast<const char *>(head), sizeof head);
    file.write(reinterpret_cast<const char *>(buffer.data()), buffer.size() * sizeof(double));
    file.flush();
    if (!file)
      throw OutputError("the file \"" + stem +
                        ".rows\" cannot be written; give a folder with write permission and free space");
    written = {size(), written.bytes + sizeof head + buffer.size() * sizeof(double), head[1]};
    buffer.clear();
  }

  RowFile::Place RowFile::read_blocks(const unsigned long n,
                                      const std::function<void(const std::vector<double> &)> &use) const
  {
    Place place;
    if (n == 0)
      return place;
    std::ifstream rows(stem + ".rows", std::ios::binary);
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(stem + ".rows", ignored), row = columns.size() * sizeof(double);
    std::vector<double> block;
    for (std::uint64_t head[2]; place.rows < n;
         place = {place.rows + head[0], place.bytes + sizeof head + block.size() * sizeof(double), head[1]})
    {
      if (!rows.read(reinterpret_cast<char *>(head), sizeof head) || head[0] == 0 ||
          head[0] > n - place.rows || head[0] > (size - place.bytes) / row)
        break;
      block.resize(head[0] * columns.size());
      if (!rows.read(reinterpret_cast<char *>(block.data()), block.size() * sizeof(double)) ||
          sum_of_block(place.sum, head[0], block) != head[1])
        break;
      use(block);
    }
    return place;
  }

  void RowFile::exchange(const std::string &name, CheckpointFile &checkpoint)
  {
    if (!checkpoint.reading())
      flush();
    unsigned long n = size();
    // as halves: a number of a checkpoint holds 53 bits
    std::vector<double> sum = {double(written.sum >> 32), double(written.sum & 0xffffffffu)};
    checkpoint(name + "/lines", n);
    checkpoint(name + "/sum", sum);
    if (checkpoint.reading())
      resume(n, sum.size() == 2 ? (static_cast<unsigned long long>(sum[0]) << 32) +
                                      static_cast<unsigned long long>(sum[1])
                                : 0);
  }

  void RowFile::resume(const unsigned long n, const unsigned long long sum)
  {
    if (n == 0)
      return; // nothing had been flushed yet
    const Place place = read_blocks(n, [](const std::vector<double> &) {});
    if (place.rows == n && place.sum == sum)
      written = place;
    // a run that came to its end has the columns only
    else if (!take_columns(n))
      throw RowsLost("The checkpoint counts " + std::to_string(n) + " lines in \"" + stem +
                     ".rows\", which are gone, damaged or those of another run" +
                     (place.rows > 0 && place.rows < n
                          ? " from line " + std::to_string(place.rows + 1) + " on"
                          : std::string()) +
                     ": run the file without --resume.");
  }

  bool RowFile::take_columns(const unsigned long n)
  {
    if (!fs::exists(stem + ".h5"))
      return false;
    std::vector<double> rows;
    try
    {
      Hdf5Reader earlier(stem + ".h5");
      for (unsigned int k = 0; k < columns.size(); ++k)
      {
        const std::vector<double> values = earlier.numbers(columns[k]);
        if (values.size() < n)
          return false;
        rows.resize(n * columns.size());
        for (unsigned long i = 0; i < n; ++i)
          rows[i * columns.size() + k] = values[i];
      }
      earlier.verify();
    }
    catch (const InputError &)
    {
      return false;
    }
    buffer = std::move(rows);
    return true;
  }

  std::vector<double> RowFile::column(const unsigned int k) const
  {
    std::vector<double> values;
    values.reserve(size());
    const auto take = [&](const std::vector<double> &rows)
    {
      for (std::size_t i = k; i < rows.size(); i += columns.size())
        values.push_back(rows[i]);
    };
    if (read_blocks(written.rows, take).sum != written.sum)
      throw OutputError("the file \"" + stem + ".rows\" was changed during the run; run again");
    take(buffer);
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

  void write_rows_as_table(const std::string &stem, const std::vector<std::string> &columns,
                           const std::string &prefix, const std::vector<std::string> &notes,
                           const std::string &table_name)
  {
    Hdf5Reader file(stem + ".h5");
    std::vector<std::vector<double>> values;
    for (const std::string &name : columns)
      values.push_back(file.numbers(name == "time_s" ? name : prefix + name));
    Table table(columns, notes);
    std::vector<Table::Cell> line(columns.size());
    for (std::size_t i = 0; i < values[0].size(); ++i)
    {
      for (std::size_t k = 0; k < line.size(); ++k)
        line[k].emplace<double>(values[k][i]);
      table.add_row(line);
    }
    table.write(table_name);
  }
} // namespace vibrocontact
