#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A face of a body's surface: a triangle or a quadrilateral of any degree, the polynomial through its nodes.
  ///
  ///     quadrilateral, degree 2: 6 7 8     triangle: corners 0 1 2, then the middles of 0-1, 1-2, 2-0
  ///                              3 4 5
  ///                              0 1 2
  struct SurfaceFace
  {
    bool triangle = false;
    unsigned int degree = 1;
    /// [m]
    std::vector<dealii::Point<3>> nodes;
    /// 1 if the tangents along its two coordinates turn to the outer side, else -1
    double side = 1;

    /// Shape functions at a point of the unit square or triangle.
    void shapes(const dealii::Point<2> &s, std::vector<double> &values) const;
    dealii::Point<3> place(const dealii::Point<2> &s) const;
    /// Along the two coordinates [m].
    std::array<dealii::Tensor<1, 3>, 2> tangents(const dealii::Point<2> &s) const;
    /// Outwards; its length is the area element [m^2].
    dealii::Tensor<1, 3> area_vector(const dealii::Point<2> &s) const;
    dealii::Point<2> middle() const;
    /// In order around it.
    std::vector<dealii::Point<3>> corners() const;
    /// between corners [m]
    double diameter() const;
    /// whether its two coordinates are affine in space
    bool is_affine() const;
    /// [m^2]
    double area() const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &triangle &degree &nodes &side;
    }

    /// Nodes of the unit square or triangle in the order of @p nodes.
    static std::vector<dealii::Point<2>> unit_nodes(bool triangle, unsigned int degree);
  };

  /// A point that two faces share, seen along the normal of the first.
  struct SharedPoint
  {
    /// in the coordinates of each face
    dealii::Point<2> on_first, on_second;
    /// of an integral over the first face [m^2]
    double weight = 0;
  };

  /// The part of a face that another one covers.
  struct FaceOverlap
  {
    std::vector<SharedPoint> points;
    /// the largest distance along the normal, positive open [m]
    double gap = 0;
  };

  /// Where two faces lie over each other: both are projected along the normal in the middle of the first, cut, and what is common
  /// is divided into triangles with Gauss points. With flat faces integrals of products of their shape functions are exact, to
  /// round-off on affine ones. The rule grows where a distorted quadrilateral makes rational functions of them.
  ///
  /// Convex pieces are cut by half planes, edge by edge, which takes edges that nearly coincide - the rule for two meshes of one
  /// surface - without a special case. Curved faces are cut into four pieces per direction pair.
  FaceOverlap overlap_of(const SurfaceFace &first, const SurfaceFace &second);
} // namespace vibrocontact
