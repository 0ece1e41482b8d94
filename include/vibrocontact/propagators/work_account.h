#pragma once

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/base/dense.h>
#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/propagators/step_weights.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Where the energy of a body on a road goes, in J:
  ///
  ///   initial + input - returned - impacts - friction  =  stored + damping + imbalance
  ///
  /// input and returned: power of the road on the contact (q u_r', and -T W of a belt) where it is positive and where it is
  /// negative, the spring of a normal law that yields being of the body, whose stored energy has it; impacts: lost by inelastic impacts of rigid points, J (u_r' - (v- + v+) / 2). What is stored and damped
  /// is known of bodies of real modes alone, about their equilibrium under the loads.
  struct WorkAccount
  {
    double input = 0, returned = 0, impacts = 0, friction = 0;
    /// with real modes
    bool has_modes = false;
    double initial = 0, stored = 0, damping = 0;
    /// smallest value so far of what all contact forces have done on the body: below zero it has given energy
    double least_work = 0;

    /// of the contact forces on the body
    double work() const { return input - returned - impacts - friction; }
    double available() const { return initial + input; }
    double imbalance() const { return initial + work() - stored - damping; }
    /// A step's or piece's work of the road on the contact.
    void add_power(const double work) { (work > 0 ? input : returned) += std::abs(work); }
    void exchange(CheckpointFile &file);
  };

  /// Energies of a model whose poles are those of real modes, u = psi eta, with z = (eta - j (eta' + zeta w eta) / w_d) / 2
  /// from the equilibrium under the loads:  eta = 2 Re z, eta' = 2 Re lambda z.
  class ModalEnergy
  {
  public:
    using Complex = std::complex<double>;
    /// Whether the poles are those of real modes, none damped beyond critical, and no rest relaxes beside them.
    static bool applies(const BodyInContact &model);
    /// What a unit modal force adds to z'.
    static Complex gain(Complex pole);
    explicit ModalEnergy(const BodyInContact &model);

    /// z less the equilibrium's
    std::vector<Complex> from_equilibrium(const std::vector<Complex> &state) const;
    /// 1/2 sum eta'^2 + w^2 eta^2 [J], of what from_equilibrium() gives
    double energy(const std::vector<Complex> &state) const;
    /// sum 2 zeta w eta'^2 [W]
    double damping_power(const std::vector<Complex> &state) const;

  private:
    const BodyInContact &model;
  };

  /// The modes' own account of a stepped motion, exact for the force interpolation whatever the length of the step: a second
  /// propagation of their states, that also tells the work W of the forces on them, and so what damping took,
  /// E(0) + W - E. Cost: the modal forces of a step, one product with the shapes.
  class SteppedModalWork
  {
  public:
    using Complex = std::complex<double>;
    SteppedModalWork(const BodyInContact &model, const std::vector<Complex> &state, double time_step,
                     ForceInterpolation interpolation);

    /// The next step. @param q forces, n_rows [N]
    void add(const double *q);
    /// of the modes and of the residual flexibility [J]
    double energy() const;
    double damping() const;
    void exchange(CheckpointFile &file);

  private:
    /// shapes times forces
    void set_modal_force(const DenseVector &q, DenseVector &on_modes) const;

    const BodyInContact &model;
    const ModalEnergy modes;
    const double h;
    const ForceInterpolation interpolation;
    /// z, and what a unit modal force adds to its rate
    std::vector<Complex> z, gains;
    StepWeights weights;
    /// n_poles x n_rows
    DenseMatrix shapes;
    /// forces of the last step; on the modes, of this step and the one before
    DenseVector last, modal_force, last_modal_force;
    double initial = 0, work = 0;
  };
} // namespace vibrocontact
