#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Rows of cells by the names of their columns, written as a CsvTable.
  struct TextTable
  {
    /// for messages: the file, and the entry that names it
    std::string source;
    std::vector<std::string> names;
    /// cells of each row, one per name, without blanks at their ends; may be empty
    std::vector<std::vector<std::string>> rows;
    /// line of the file of each row, from 1
    std::vector<unsigned int> lines;

    /// number of a column; nothing if there is none of this name
    std::optional<unsigned int> find(const std::string &name) const;
    /// @throws InputError that names the columns there are
    unsigned int column(const std::string &name) const;
    /// "source, line 7, "
    std::string where(unsigned int row) const;
    /// A cell as a number. @throws InputError with the line if it is none or not finite
    double number(unsigned int row, unsigned int column) const;
  };

  /// @param source begins the messages @throws InputError with source and line
  TextTable read_text_table(const std::string &source, const std::string &bytes);

  /// Columns of numbers by name, from a text such as
  ///
  ///     # measured on 3 May
  ///     time_s, normal_force_N
  ///     0, 66000
  ///     0.1, 70000
  ///
  /// # begins a comment; the first other line names the columns. A byte-order mark of UTF-8 is skipped.
  struct CsvTable
  {
    /// for messages: the file, and the entry that names it
    std::string source;
    std::vector<std::string> names;
    /// one per name, equally long
    std::vector<std::vector<double>> columns;
    /// line of the file of each row, from 1
    std::vector<unsigned int> lines;

    /// null if there is no such column
    const std::vector<double> *find(const std::string &name) const;
    /// @throws InputError that names the columns there are
    const std::vector<double> &column(const std::string &name) const;
  };

  /// @param source begins the messages, see CsvTable::source
  /// @throws InputError with source and line
  CsvTable read_csv(const std::string &source, const std::string &bytes);

  /// The table in a file that an entry of the parameter file names. Collective.
  /// @throws InputError with entry, file and line
  CsvTable read_csv_file(const std::string &file_name, const std::string &entry);

  /// Piecewise linear function.
  class LinearTable
  {
  public:
    /// @param source for messages, such as a file and a column
    /// @throws InputError if x does not increase or there are less than two points
    LinearTable(const std::string &source, const std::vector<double> &x, const std::vector<double> &y);
    /// @throws InputError outside the table
    double operator()(double x) const;

  private:
    std::string source;
    std::vector<double> x, y;
  };
} // namespace vibrocontact
