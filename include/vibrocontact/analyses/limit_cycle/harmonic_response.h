#pragma once

#include <vibrocontact/base/complex_dense.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/moving_shapes.h>

#include <vector>

namespace vibrocontact
{
  /// What the pair answers at some contact points to forces that repeat themselves, by the harmonics of both: gaps and slips,
  ///
  ///   Y_k = L_k (Psi G_k Psi^T + sum_p [ r_p l_p^T / (j k w - lambda_p) + conj ]) + D W~ + j k w W~_t
  ///   G_k = diag(w_n^2 - (k w)^2 + 2 j zeta_n w_n k w)^-1,      conj: of r, l and lambda
  ///
  /// L_k: normal rows as they are, V d/dx + j k w of the tangential ones; D likewise without the rate; w: 2 pi over the period.
  /// Nothing is differenced in time. Columns of numbers over the period are [mean, Re 1, Im 1, Re 2, ...], x = sum_k x_k e^(j k w t) over
  /// all k of both signs (numerics/time_basis.h). For pairs whose rest follows at once.
  class HarmonicResponse
  {
  public:
    /// @param points of the grid, ascending @param shapes shapes_of_steps() of the pair @param n_harmonics beside the mean
    /// @pre all modes have a frequency: constant forces hold them
    HarmonicResponse(const ContactPair &pair, const CreepScheme &scheme, double speed,
                     const PatchShapes &shapes, const std::vector<unsigned int> &points,
                     unsigned int n_harmonics);

    unsigned int n_rows() const { return rest.m(); }
    unsigned int n_functions() const { return 2 * n_harmonics + 1; }
    /// w [rad/s]
    void set_frequency(double omega);

    /// Y of changes of the forces, and its derivative by w; 3 n_points x n_functions each
    DenseMatrix response(const DenseMatrix &forces) const;
    DenseMatrix response_slope(const DenseMatrix &forces) const;
    /// The part of the slips that is the rate of the residual displacements, and its derivative by w [m/s].
    DenseMatrix rate_of_rest(const DenseMatrix &forces) const;
    DenseMatrix rate_of_rest_slope(const DenseMatrix &forces) const;
    /// Y_k, 3 n_points square
    ComplexMatrix of_order(unsigned int k) const;
    /// j k w W~_t, 3 n_points square
    ComplexMatrix rate_of_rest_of_order(unsigned int k) const;
    /// Amplitudes of the modes; n_modes x n_functions
    DenseMatrix modal_amplitudes(const DenseMatrix &forces) const;
    /// States of the poles, real parts above imaginary ones; 2 n_poles x n_functions
    DenseMatrix pole_states(const DenseMatrix &forces) const;
    /// How much each row yields to a force of its own at the highest order, resonances left out: normal rows [m/N], tangential ones
    /// [m/(s N)]; 3 n_points, > 0.
    std::vector<double> own_compliance() const;
    /// j k w of each order, in place
    void differentiate(DenseMatrix &columns) const;

  private:
    /// Harmonics of the forces on the shapes that they act through; n_loaded rows
    DenseMatrix on_loaded_shapes(const DenseMatrix &forces) const;
    DenseMatrix along(const DenseMatrix &forces, const std::vector<ComplexMatrix> &displacement,
                      const std::vector<ComplexMatrix> &velocity, double rate) const;

    const ContactPair &pair;
    const unsigned int n_harmonics;
    /// on the rows of the points
    const MovingShapes moving;
    /// W~, gaps and slips by it, and its tangential rows; 3 n_points square
    DenseMatrix rest, by_rest, tangential_rest;
    double omega = 0;
    /// What the shapes answer to forces on the loaded ones and its derivative by w, j k w times the former and its derivative, by order;
    /// rank x n_loaded
    std::vector<ComplexMatrix> receptance, receptance_slope, mobility, mobility_slope;
  };
} // namespace vibrocontact
