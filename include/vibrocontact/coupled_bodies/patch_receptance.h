#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>

#include <complex>
#include <functional>
#include <vector>

namespace vibrocontact
{
  /// How a body moves the contact under forces there beside what of it follows them at once, at any complex s:
  ///
  ///   du = basis G(s) forces^T R,     R, du e^(s t)
  ///
  /// G between some ten patch shapes (PatchShapes): by modes, by poles, or any function of s that is analytic where it is asked
  /// for. Of a body that turns left and right shapes differ.
  struct PatchReceptance
  {
    using Function = std::function<ComplexMatrix(const std::complex<double> &)>;
    using Product = std::function<ComplexVector(const std::complex<double> &, const ComplexVector &)>;
    /// 3 n x rank, in the rows of the pair [-]
    DenseMatrix basis;
    /// G(s), rank x rank of the forces [m/N], and dG/ds [m s/N]; without a derivative it is differenced
    Function value, derivative;
    /// G(s) v and dG/ds v, for less than G costs; empty: by G itself
    Product times = {}, derivative_times = {};
    /// the shapes that forces act on, 3 n x their rank [-]; empty: basis
    DenseMatrix forces = DenseMatrix();
    /// what d/dx of the basis is beyond the differences between points (BodyInContact::gradient), 3 n x rank [1/m]; empty:
    /// nothing
    DenseMatrix gradient = DenseMatrix();

    const DenseMatrix &shapes_of_forces() const { return forces.m() > 0 ? forces : basis; }
  };

  /// G of the modes of body b (from 1), amplitudes (s^2 + 2 zeta w s + w^2 + j H)^-1 amplitudes^T, with their hysteretic loss or
  /// without (null); with the dampers of a hub. H in full is diagonalised once, so that an s costs the same either way.
  /// @throws InputError if H couples modes that have viscous damping
  PatchReceptance modal_receptance(const ContactPair &pair, unsigned int b, const HystereticLoss *loss);
  /// G of the poles of body b, sum of right left^T / (s - lambda) and of its conjugate, in shapes of their own for motion and
  /// force; with their gradient.
  PatchReceptance pole_receptance(const ContactPair &pair, unsigned int b);
  /// Of all bodies with modes or poles, body 1 first, but for those that the loss has exactly. Equilibria on the same pair
  /// share them: their shapes cost more than all else of F.
  std::vector<PatchReceptance> patch_receptances(const ContactPair &pair, const HystereticLoss *loss);
  /// The same with those behind them that the loss has exactly (ExactReceptance::nearby): of all bodies, to follow roots.
  std::vector<PatchReceptance> all_patch_receptances(const ContactPair &pair, const HystereticLoss *loss);
} // namespace vibrocontact
