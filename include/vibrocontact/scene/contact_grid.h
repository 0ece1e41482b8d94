#pragma once

#include <string>

namespace vibrocontact
{
  /// How the traction of a contact point is spread over a meshed body's surface.
  enum class TractionShape : unsigned char
  {
    /// constant on the point's cell ("lumped" quadrature)
    constant,
    /// bilinear hat over the neighbouring points ("consistent" quadrature, Lai et al. 2018, Eq. 7)
    bilinear
  };

  /// Regular grid of potential contact points in the tangent plane z = 0.
  ///
  /// Each point is the centre of a rectangular cell of size spacing_x * spacing_y; that cell is the point's
  /// tributary area on both bodies and carries a constant traction.
  ///
  ///      y ^   +---+---+---+---+      index = j * n_x + i,  x fastest
  ///        |   | o | o | o | o |      x(i) = x_first + i * spacing_x
  ///        |   +---+---+---+---+      y(j) = y_first + j * spacing_y
  ///        |   | o | o | o | o |      contact travels towards -x, material flows towards +x:
  ///        +-> +---+---+---+---+      the leading (upstream) side is the one of smallest x
  ///         x
  ///
  /// Coordinates are relative to the nominal contact point, which is a grid point unless the grid is offset.
  struct ContactGrid
  {
    /// number of points along x (rolling direction line) and y (lateral)
    unsigned int n_x = 0, n_y = 0;
    /// size of a cell [m]
    double spacing_x = 0, spacing_y = 0;
    /// coordinates of the first point (smallest x and y) [m]
    double x_first = 0, y_first = 0;
    TractionShape traction = TractionShape::constant;
    /// the body brings these points itself, section Contact does not make them
    bool of_body = false;
    /// nothing of the body beside these points can touch (a layer, points of matrices or measured ones, a few treads), so that the contact may fill the grid
    bool whole_surface = false;

    unsigned int n_points() const { return n_x * n_y; }
    unsigned int index(const unsigned int i, const unsigned int j) const { return j * n_x + i; }
    double x(const unsigned int point) const { return x_first + (point % n_x) * spacing_x; }
    double y(const unsigned int point) const { return y_first + (point / n_x) * spacing_y; }
    /// tributary area of every point [m^2]
    double cell_area() const { return spacing_x * spacing_y; }
  };

  /// The only point of a body. @param cell its width along x and y [m]
  inline ContactGrid single_point(const double cell)
  {
    ContactGrid point;
    point.n_x = point.n_y = 1;
    point.spacing_x = point.spacing_y = cell;
    return point;
  }

  /// Contact components are stored component by component: normal of all points, then x, then y.
  /// Row of component c (0 normal, 1 x, 2 y) at a point, in any vector or matrix of size 3 * n_points.
  inline unsigned int contact_row(const unsigned int n_points, const unsigned int component,
                                  const unsigned int point)
  {
    return component * n_points + point;
  }
} // namespace vibrocontact
