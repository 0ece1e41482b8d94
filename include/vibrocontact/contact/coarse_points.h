#pragma once

#include <vibrocontact/contact/interface.h>

#include <vector>

namespace vibrocontact
{
  /// Contact points taken together two by two (along x, y or both; a single row stays one), for an error from the same
  /// compliance on a coarser grid. A force on a coarse point is spread equally over its fine ones, a displacement is their
  /// mean. Of an odd number of columns or rows the last stays alone, as if it were as wide as the others.
  class CoarsePoints
  {
  public:
    explicit CoarsePoints(const PlacedContacts &fine);
    /// grids of twice the spacing
    const PlacedContacts &contacts() const { return coarse; }
    /// Whether any contact has fewer points.
    bool exist() const { return coarse.n_points() < n_fine; }
    /// Gaps and jumps under loads are means.
    ContactInterface interface(const ContactInterface &fine) const;
    /// @param fine compliance or gradient, 3 n square of the fine points; empty: so is the result
    DenseMatrix matrix(const DenseMatrix &fine) const;

  private:
    /// rows of the fine points of coarse row k: at most 4
    std::vector<std::vector<unsigned int>> rows;
    PlacedContacts coarse;
    unsigned int n_fine;
  };
} // namespace vibrocontact
