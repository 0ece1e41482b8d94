#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/waveguide/section_matrices.h>

#include <vector>

namespace vibrocontact
{
  /// What is kept of a periodic track in contact (track_in_contact.h), G = bed + motions (R(omega) - on_bed) motions^T.
  struct TrackReduction
  {
    unsigned int n_dofs = 0;
    SectionShapes section;
    /// by which rotations are lengths [m]
    double radius = 0;
    /// 3 n square [m/N]; 3 n x 6; 6 square [m/N]
    DenseMatrix bed, motions, at_rest, at_once, on_bed;
    /// n [m]
    std::vector<double> surface_height;
    /// ascending [Hz]
    std::vector<double> frequency;
    /// row k: R at frequency k, [i * 6 + j] [m/N]
    DenseMatrix real, imaginary;
    double seconds = 0;
  };
} // namespace vibrocontact
