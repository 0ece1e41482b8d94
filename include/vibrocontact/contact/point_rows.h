#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/scene/contact_grid.h>

#include <vector>

namespace vibrocontact
{
  /// The rows of some of n points by contact_row(), normal ones first.
  inline std::vector<unsigned int> rows_of_points(const unsigned int n,
                                                  const std::vector<unsigned int> &points)
  {
    std::vector<unsigned int> rows;
    for (unsigned int c = 0; c < 3; ++c)
      for (const unsigned int point : points)
        rows.push_back(contact_row(n, c, point));
    return rows;
  }

  /// Of 3 numbers for each point those of some.
  inline DenseVector on_points(const DenseVector &all, const std::vector<unsigned int> &points)
  {
    DenseVector result(3 * points.size());
    unsigned int to = 0;
    for (const unsigned int row : rows_of_points(all.size() / 3, points))
      result[to++] = all[row];
    return result;
  }
} // namespace vibrocontact
