#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/utf8.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    std::string no_column(const std::string &source, const std::string &name,
                          const std::vector<std::string> &names)
    {
      return source + " has no column " + name + "; it has " + quoted_list(names, "and") + ".";
    }
  } // namespace

  const std::vector<double> *CsvTable::find(const std::string &name) const
  {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? nullptr : &columns[found - names.begin()];
  }

  const std::vector<double> &CsvTable::column(const std::string &name) const
  {
    const std::vector<double> *const found = find(name);
    if (!found)
      throw InputError(no_column(source, name, names));
    return *found;
  }

  namespace
  {
    std::vector<std::string> cells_of(const std::string &line)
    {
      std::vector<std::string> cells;
      std::istringstream stream(line + ","); // also an empty cell at the end counts
      for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(trimmed(cell));
      return cells;
    }

    void check_names(const std::vector<std::string> &names, const std::string &where)
    {
      for (const std::string &name : names)
        if (name.empty())
          throw InputError(where + "leaves a column without a name: take out the comma or name it.");
        else if (std::count(names.begin(), names.end(), name) > 1)
          throw InputError(where + "names the column " + name + " twice: leave one of them.");
    }
  } // namespace

  std::optional<unsigned int> TextTable::find(const std::string &name) const
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      return {};
    return found - names.begin();
  }

  unsigned int TextTable::column(const std::string &name) const
  {
    const std::optional<unsigned int> found = find(name);
    if (!found)
      throw InputError(no_column(source, name, names));
    return *found;
  }

  std::string TextTable::where(const unsigned int row) const
  {
    return source + ", line " + std::to_string(lines[row]) + ", ";
  }

  double TextTable::number(const unsigned int row, const unsigned int column) const
  {
    const std::string &cell = rows[row][column];
    char *end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty())
      throw InputError(where(row) + "has no value in the column " + names[column] +
                       ": give one in every line.");
    if (*end != 0 || !std::isfinite(value))
      throw InputError(where(row) + "has '" + cell + "' where a number is due.");
    return value;
  }

  TextTable read_text_table(const std::string &source, const std::string &bytes)
  {
    const std::string text = as_utf8(bytes);
    TextTable table;
    table.source = source;
    const std::string mark = "\xef\xbb\xbf"; // of UTF-8, as spreadsheets write it
    std::istringstream lines(text.compare(0, mark.size(), mark) == 0 ? text.substr(mark.size()) : text);
    unsigned int number = 0;
    for (std::string line; std::getline(lines, line);)
    {
      ++number;
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty())
        continue;
      const std::string where = source + ", line " + std::to_string(number) + ", ";
      if (line.find(';') != std::string::npos)
        throw InputError(where +
                         "has semicolons: separate the columns by commas, with points in the numbers.");
      std::vector<std::string> cells = cells_of(line);
      if (table.names.empty())
      {
        check_names(cells, where);
        table.names = cells;
        continue;
      }
      if (cells.size() != table.names.size())
        throw InputError(where + "has " + std::to_string(cells.size()) + " values for " +
                         std::to_string(table.names.size()) +
                         " columns: separate them by commas, with points in the numbers.");
      table.lines.push_back(number);
      table.rows.push_back(std::move(cells));
    }
    if (table.names.empty())
      throw InputError(source + " is empty: its first line names the columns, the rows follow.");
    return table;
  }

  CsvTable read_csv(const std::string &source, const std::string &bytes)
  {
    const TextTable text = read_text_table(source, bytes);
    CsvTable table;
    table.source = source;
    table.names = text.names;
    table.lines = text.lines;
    table.columns.resize(text.names.size());
    for (unsigned int row = 0; row < text.rows.size(); ++row)
      for (unsigned int k = 0; k < table.columns.size(); ++k)
        table.columns[k].push_back(text.number(row, k));
    return table;
  }

  CsvTable read_csv_file(const std::string &file_name, const std::string &entry)
  {
    std::string text;
    try
    {
      text = read_file_on_all_ranks(file_name, "table");
    }
    catch (const InputError &error)
    {
      throw InputError(entry + ": " + error.what() +
                       ", which is looked for beside the parameter file, then in the working folder.");
    }
    return read_csv(entry + ": the table \"" + file_name + "\"", text);
  }

  LinearTable::LinearTable(const std::string &source, const std::vector<double> &x,
                           const std::vector<double> &y)
      : source(source), x(x), y(y)
  {
    if (x.size() < 2)
      throw InputError(source + " has less than two rows: give the range that is needed.");
    for (std::size_t i = 1; i < x.size(); ++i)
      if (!(x[i] > x[i - 1]))
      {
        std::ostringstream text;
        text << source << " is given at " << x[i] << " after " << x[i - 1]
             << ": the rows have to stand in ascending order.";
        throw InputError(text.str());
      }
  }

  double LinearTable::operator()(const double value) const
  {
    // round-off of a last time step is no matter
    const double slack = 1e-9 * (x.back() - x.front());
    if (!(value >= x.front() - slack && value <= x.back() + slack))
    {
      std::ostringstream text;
      text << source << (value < x.front() ? " begins at " : " ends at ")
           << (value < x.front() ? x.front() : x.back()) << ", but " << value << " is needed: extend it.";
      throw InputError(text.str());
    }
    const std::size_t k =
        std::clamp<std::ptrdiff_t>(std::upper_bound(x.begin(), x.end(), value) - x.begin(), 1, x.size() - 1);
    const double share = std::clamp((value - x[k - 1]) / (x[k] - x[k - 1]), 0., 1.);
    return y[k - 1] + share * (y[k] - y[k - 1]);
  }
} // namespace vibrocontact
