#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/label_text.h>
#include <vibrocontact/base/table.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <cstdio>

namespace vibrocontact
{
  Table::Table(const std::vector<std::string> &columns, const std::vector<std::string> &comments)
      : columns(columns)
  {
    for (const auto &comment : comments)
      content += "# " + comment + "\n";
    for (std::size_t i = 0; i < columns.size(); ++i)
      content += (i ? "," : "") + columns[i];
    content += "\n";
  }

  void Table::add_row(const std::vector<Cell> &cells)
  {
    AssertThrow(cells.size() == columns.size(), dealii::ExcDimensionMismatch(cells.size(), columns.size()));
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (i)
        content += ",";
      if (const auto *number = std::get_if<double>(&cells[i]))
      {
        if (!std::isfinite(*number))
          throw ConvergenceError(
              "The column " + columns[i] +
              " of a table of results got a number that is not finite: numbers of the input lie "
              "too far apart for double precision.");
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g", *number);
        content += digits;
      }
      else
        content += label_in_a_table(std::get<std::string>(cells[i]));
    }
    content += "\n";
    ++rows;
  }

  void Table::write(const std::string &file_name) const
  {
    write_file(file_name, content);
  }
} // namespace vibrocontact
