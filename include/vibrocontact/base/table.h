#pragma once

#include <string>
#include <variant>
#include <vector>

namespace vibrocontact
{
  /// A table written as CSV: lines that begin with # (what it is, sign conventions), one line of column names
  /// with units such as pressure_Pa, then the rows. Numbers carry 17 digits; whole numbers have no point. In
  /// texts a semicolon stands for a comma and a slash for #: axial(0;2)/2 is the mode axial(0,2)#2.
  ///
  ///     Table table({"x_m", "pressure_Pa", "label"}, {"Centre line, y = 0", "pressure > 0 is compression"});
  ///     table.add_row({0.001, 1.06e9, "axial(0,2)"});
  ///     table.write(folder + "/centre_line.csv");      // on rank 0
  class Table
  {
  public:
    using Cell = std::variant<double, std::string>;

    Table(const std::vector<std::string> &columns, const std::vector<std::string> &comments);
    /// @throws ConvergenceError if a number is not finite, dealii::ExceptionBase if the number of cells differs from the
    /// header
    void add_row(const std::vector<Cell> &cells);
    unsigned int n_rows() const { return rows; }
    std::string text() const { return content; }
    /// Whole or not at all; call on one rank.
    void write(const std::string &file_name) const;

  private:
    std::vector<std::string> columns;
    std::string content;
    unsigned int rows = 0;
  };
} // namespace vibrocontact
