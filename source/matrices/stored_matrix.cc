#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/text_lines.h>
#include <vibrocontact/matrices/stored_matrix.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vibrocontact
{
  namespace
  {
    std::string place(const StoredEntry &entry)
    {
      return "(" + std::to_string(entry.row + 1) + ", " + std::to_string(entry.column + 1) + ")";
    }

    bool same_place(const StoredEntry &a, const StoredEntry &b)
    {
      return a.row == b.row && a.column == b.column;
    }
  } // namespace

  std::vector<StoredEntry> lower_triangle(StoredMatrix matrix)
  {
    if (matrix.n_rows != matrix.n_columns)
      throw InputError(matrix.source + " holds a matrix of " + std::to_string(matrix.n_rows) + " by " +
                       std::to_string(matrix.n_columns) + ", but a square one is due.");
    // the upper triangle is turned down; a flag remembers it
    std::vector<std::pair<StoredEntry, bool>> turned;
    turned.reserve(matrix.entries.size());
    std::vector<double> diagonal(matrix.n_rows, 0.);
    for (StoredEntry &entry : matrix.entries)
    {
      const bool upper = entry.column > entry.row;
      if (entry.row == entry.column)
        diagonal[entry.row] = std::abs(entry.value);
      if (upper)
        std::swap(entry.row, entry.column);
      turned.emplace_back(entry, upper);
    }
    matrix.entries.clear();
    std::sort(turned.begin(), turned.end(),
              [](const auto &a, const auto &b)
              {
                return std::make_tuple(a.first.row, a.first.column, a.second, a.first.line) <
                       std::make_tuple(b.first.row, b.first.column, b.second, b.first.line);
              });
    std::vector<StoredEntry> result;
    result.reserve(turned.size());
    for (std::size_t k = 0; k < turned.size(); ++k)
    {
      const auto &[entry, upper] = turned[k];
      const bool is_next_same = k + 1 < turned.size() && same_place(entry, turned[k + 1].first);
      if (is_next_same && (matrix.one_triangle || turned[k + 1].second == upper))
        throw InputError(matrix.source + ", line " + std::to_string(turned[k + 1].first.line) +
                         ", gives the entry " + place(entry) + " that line " + std::to_string(entry.line) +
                         " has given: give each entry once" +
                         (matrix.one_triangle ? ", of a symmetric matrix one triangle alone." : "."));
      StoredEntry one = entry;
      if (!matrix.one_triangle && entry.row != entry.column)
      {
        const double other = is_next_same ? turned[k + 1].first.value : 0.;
        const double scale = std::max(std::sqrt(diagonal[entry.row] * diagonal[entry.column]),
                                      is_next_same ? std::max(std::abs(entry.value), std::abs(other)) : 0.);
        if (!(std::abs(entry.value - other) <= 1e-9 * scale))
        {
          const StoredEntry lower = entry;
          StoredEntry upper_place = entry;
          std::swap(upper_place.row, upper_place.column);
          const StoredEntry &here = upper ? upper_place : lower, &there = upper ? lower : upper_place;
          throw InputError(matrix.source + ", line " + std::to_string(entry.line) +
                           ", is not symmetric: the entry " + place(here) + " is " +
                           number_text(entry.value) + ", but " + place(there) + " is " + number_text(other) +
                           "; give a symmetric matrix.");
        }
        one.value = (entry.value + other) / 2;
        k += is_next_same;
      }
      result.push_back(one);
    }
    return result;
  }

  StoredMatrix read_calculix_matrix(const std::string &source, const std::string &bytes, const unsigned int n)
  {
    StoredMatrix matrix;
    matrix.source = source;
    matrix.n_rows = matrix.n_columns = n;
    matrix.one_triangle = true;
    TextLines lines(source, bytes);
    while (lines.next())
    {
      std::string_view rest = lines.line();
      const std::string_view row_word = next_word(rest), column_word = next_word(rest),
                             word = next_word(rest);
      if (row_word.empty())
        continue;
      unsigned long row = 0, column = 0;
      double value = 0;
      if (!is_count(row_word, row) || !is_count(column_word, column) || !is_number(word, value) ||
          !std::isfinite(value) || !next_word(rest).empty())
        throw InputError(lines.where() +
                         ", is no 'row column value' with a finite number: the file is damaged; "
                         "write it anew.");
      if (row < 1 || column < 1 || row > n || column > n)
        throw InputError(lines.where() + ", names the entry (" + std::to_string(row) + ", " +
                         std::to_string(column) + ") of a matrix of " + std::to_string(n) +
                         " dofs: the files belong to different models, or one of them is damaged.");
      matrix.entries.push_back(
          {static_cast<unsigned int>(row - 1), static_cast<unsigned int>(column - 1), value, lines.number()});
    }
    return matrix;
  }
} // namespace vibrocontact
