#pragma once

#include <vibrocontact/fe/surface_trace.h>
#include <vibrocontact/reduction/modes.h>

#include <vector>

namespace vibrocontact
{
  /// The modes of a body on its surface: what probes hear and animated shapes show. Kept beside the modes in
  /// the cache (`<body>-shapes-<hash>.h5`, same key), in single precision; replicated on all ranks. Get it by
  /// BodyReduction::surface_shapes().
  ///
  ///   displacement of point i along d = sum_k value(i, d, k) q_k,      q = sum over the modes of this body
  struct SurfaceShapes
  {
    /// x, y, z of one point after the other, contact frame [m]; 3 n_points
    std::vector<double> points;
    /// four points of each face in turn around it; a line (axis of a bar or beam, plane body) is a quad
    /// a, b, b, a
    std::vector<int> quads;
    /// angular frequencies of the modes, as in ModalReduction, rigid modes first [rad/s]; n_modes
    std::vector<double> omega;
    /// mass-normalised shapes, mode after mode, each as `points` [1/sqrt(kg)]; 3 n_points n_modes
    std::vector<float> shapes;

    unsigned int n_points() const { return points.size() / 3; }
    unsigned int n_modes() const { return omega.size(); }
    dealii::Point<3> point(const unsigned int i) const
    {
      return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
    }
    double value(const unsigned int i, const unsigned int direction, const unsigned int mode) const
    {
      return shapes[points.size() * mode + 3 * i + direction];
    }
  };

  /// The modes at the points of the surface. Collective.
  SurfaceShapes surface_shapes(const SurfaceTrace &surface, const Modes &modes);

  /// The shapes of combinations of the modes. @param mixing their amplitudes, n_modes x n; empty: the shapes themselves
  SurfaceShapes mixed_shapes(const SurfaceShapes &shapes, const DenseMatrix &mixing,
                             const std::vector<double> &omega);

  /// Displacements of all points, ordered as SurfaceShapes::points [m], for amplitudes of the body's modes
  /// [m sqrt(kg)]; n_modes. For a complex root call it with the real and with the imaginary part.
  std::vector<double> surface_displacement(const SurfaceShapes &shapes,
                                           const std::vector<double> &amplitudes);
} // namespace vibrocontact
