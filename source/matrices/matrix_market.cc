#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/text_lines.h>
#include <vibrocontact/matrices/matrix_market.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    const char *const example_of_header = "%%MatrixMarket matrix coordinate real symmetric";

    /// The next line with something in it. @return false at the end
    bool next_content(TextLines &lines, std::string_view &rest)
    {
      while (lines.next())
      {
        rest = lines.line();
        std::string_view look = rest;
        const std::string_view first = next_word(look);
        if (!first.empty() && first[0] != '%')
          return true;
      }
      return false;
    }

    void check_end(const TextLines &lines, std::string_view rest)
    {
      if (!next_word(rest).empty())
        throw InputError(lines.where() + ", has more words than its format asks for.");
    }

    unsigned long count(const TextLines &lines, std::string_view &rest, const std::string &what)
    {
      const std::string_view word = next_word(rest);
      unsigned long value = 0;
      if (!is_count(word, value))
        throw InputError(lines.where() + ", has '" + std::string(word) + "' where " + what + " is due.");
      return value;
    }

    unsigned int index(const TextLines &lines, std::string_view &rest, const std::string &what,
                       const unsigned int n)
    {
      const unsigned long value = count(lines, rest, "the number of a " + what);
      if (value < 1 || value > n)
        throw InputError(lines.where() + ", names " + what + " " + std::to_string(value) +
                         " of a matrix of " + std::to_string(n) + ": they count from 1.");
      return value - 1;
    }

    double value_of(const TextLines &lines, std::string_view &rest)
    {
      const std::string_view word = next_word(rest);
      double value = 0;
      if (!is_number(word, value) || !std::isfinite(value))
        throw InputError(lines.where() + ", has '" + std::string(word) + "' where a finite number is due.");
      return value;
    }

    [[noreturn]] void refuse_end(const std::string &source, const std::string &found, const std::string &due)
    {
      throw InputError(source + " ends after " + found + " of the " + due +
                       " entries that it announces: the file is cut off; write it anew.");
    }
  } // namespace

  StoredMatrix read_matrix_market(const std::string &source, const std::string &bytes)
  {
    TextLines lines(source, bytes);
    std::string words[5];
    if (lines.next())
    {
      std::string_view rest = lines.line();
      for (std::string &word : words)
        word = lower_case(next_word(rest));
    }
    if (words[0] != "%%matrixmarket" || words[1] != "matrix")
      throw InputError(source + " is no file of Matrix Market: its first line has to be such as '" +
                       example_of_header + "'.");
    const bool coordinate = words[2] == "coordinate", symmetric = words[4] == "symmetric";
    if ((!coordinate && words[2] != "array") || (words[3] != "real" && words[3] != "integer") ||
        (!symmetric && words[4] != "general"))
      throw InputError(lines.where() + ", says '" + words[2] + " " + words[3] + " " + words[4] +
                       "', but the matrix has to be coordinate or array, real, symmetric or general.");

    StoredMatrix matrix;
    matrix.source = source;
    matrix.one_triangle = symmetric;
    std::string_view rest;
    if (!next_content(lines, rest))
      throw InputError(source + " ends before the line of its sizes: the file is cut off; write it anew.");
    const unsigned long rows = count(lines, rest, "the number of rows"),
                        columns = count(lines, rest, "the number of columns");
    constexpr unsigned long most = std::numeric_limits<int>::max();
    if (rows > most || columns > most)
      throw InputError(lines.where() + ", announces a matrix of " + std::to_string(rows) + " by " +
                       std::to_string(columns) + ", more than the program can number.");
    matrix.n_rows = rows;
    matrix.n_columns = columns;
    if (symmetric && rows != columns)
      throw InputError(lines.where() + ", announces a symmetric matrix of " + std::to_string(rows) + " by " +
                       std::to_string(columns) + ", but a symmetric one is square.");
    unsigned long due = coordinate  ? count(lines, rest, "the number of entries")
                        : symmetric ? rows * (rows + 1) / 2
                                    : rows * columns;
    check_end(lines, rest);
    // an entry takes two bytes at least, so that no number of a damaged file asks for more memory than it has bytes
    matrix.entries.reserve(std::min<unsigned long>(due, bytes.size() / 2));
    unsigned int row = 0, column = 0;
    while (matrix.entries.size() < due && next_content(lines, rest))
    {
      if (coordinate)
      {
        row = index(lines, rest, "row", rows);
        column = index(lines, rest, "column", columns);
      }
      const double value = value_of(lines, rest);
      check_end(lines, rest);
      if (coordinate || value != 0 || row == column)
        matrix.entries.push_back({row, column, value, lines.number()});
      else
        --due; // zeros of an array are no entries
      if (!coordinate && ++row == rows)
        row = symmetric ? ++column : (++column, 0);
    }
    if (matrix.entries.size() < due)
      refuse_end(source, std::to_string(matrix.entries.size()), std::to_string(due));
    if (next_content(lines, rest))
      throw InputError(lines.where() + ", goes on after the " + std::to_string(due) +
                       " entries that the file announces: mend its line of sizes.");
    return matrix;
  }

  DenseMatrix read_dense_matrix_market(const std::string &source, const std::string &bytes)
  {
    const StoredMatrix stored = read_matrix_market(source, bytes);
    if (static_cast<unsigned long>(stored.n_rows) * stored.n_columns > 100'000'000)
      throw InputError(source + " holds a matrix of " + std::to_string(stored.n_rows) + " by " +
                       std::to_string(stored.n_columns) + ", too large for a dense one.");
    DenseMatrix matrix(stored.n_rows, stored.n_columns);
    for (const StoredEntry &entry : stored.entries)
    {
      matrix(entry.row, entry.column) = entry.value;
      if (stored.one_triangle)
        matrix(entry.column, entry.row) = entry.value;
    }
    return matrix;
  }

  std::string matrix_market_text(const DenseMatrix &matrix, const bool symmetric, const std::string &comment)
  {
    char line[96];
    std::string text, entries;
    unsigned long n_entries = 0;
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = symmetric ? j : 0; i < matrix.m(); ++i)
      {
        if (symmetric && matrix(i, j) == 0)
          continue;
        if (!std::isfinite(matrix(i, j)))
          throw ConvergenceError("A matrix to be written is not finite.");
        if (symmetric)
          std::snprintf(line, sizeof line, "%u %u %.17g\n", i + 1, j + 1, matrix(i, j));
        else
          std::snprintf(line, sizeof line, "%.17g\n", matrix(i, j));
        entries += line;
        ++n_entries;
      }
    text = std::string("%%MatrixMarket matrix ") +
           (symmetric ? "coordinate real symmetric" : "array real general") + "\n% " + comment + "\n" +
           std::to_string(matrix.m()) + " " + std::to_string(matrix.n());
    if (symmetric)
      text += " " + std::to_string(n_entries);
    return text + "\n" + entries;
  }
} // namespace vibrocontact
