#pragma once

#include <vibrocontact/analyses/periodic/force_step.h>
#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/laws/normal_law.h>

#include <complex>
#include <functional>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// What a body does at one instant: displacement of the contact point [m], its velocity [m/s], contact force [N], modal
  /// coordinates, residual [m], and the energy of the body and of the law [J].
  struct MotionSample
  {
    double displacement = 0, velocity = 0, force = 0, residual = 0, energy = 0;
    std::vector<double> q, v;
  };

  /// A stretch of motion: all in flight or all in contact.
  struct OrbitPiece
  {
    /// begin of it, length [s]
    double begin, length;
    bool contact;
    /// deviation from the steady motion without contact at its begin; n_states
    std::vector<double> state;
    /// contact force at the Gauss points of the piece [N]; empty in flight
    std::vector<double> force;
  };

  struct Orbit
  {
    std::vector<OrbitPiece> pieces;
    /// touches and releases [s], in the order of time
    std::vector<double> touches, releases;
    /// of the contact force [N s]
    double impulse = 0;
  };

  /// Exact motion of a ForcedBody with one frictionless contact point over one period of the force (doc/theory.md,
  /// "References in time").
  ///
  /// Flight is the steady motion without contact plus free motion of every mode in closed form. In contact the only unknown
  /// is the scalar contact force: on steps of T / n_steps, halved until its last Legendre coefficients are below
  /// `accuracy`, a polynomial through s Gauss points, which the modes answer exactly; at the Gauss points it satisfies
  ///
  ///   e(t) = S f + d(f),   e: compression that the stop would see if there were no residual's answer to f (beta = 0)
  ///
  /// so the error is of order 2 s in the step for the law alone. With beta > 0 the residual r is a state, and e = trace q + r
  /// - gap = d(f); at the rigid stop r = gap - trace q follows the modes and e = trace q + beta trace q' + (residual
  /// answers to force and load) - gap = S f. Touches (gap zero) and releases (e zero) are located to round-off; between
  /// samples T / n_steps apart largest displacements are checked.
  ///
  /// State: q, q' of the modes, then r if it is a state. Continuous at touch and release: q, q', r and, but for the
  /// rigid stop with beta > 0, the force; there the force jumps at touch to beta u'(before) / S and u' to zero.
  class PeriodMap
  {
  public:
    /// @throws InputError if the body has more than one row of contact, if an undamped mode is excited at its own frequency,
    /// or if the stop is rigid and the body has no residual (contact node with mass)
    PeriodMap(const ForcedBody &body, std::shared_ptr<const NormalLaw> law, const HarmonicForce &force,
              unsigned int n_steps, unsigned int n_nodes = 8, double accuracy = 1e-9);

    unsigned int n_states() const { return 2 * n + (relaxed ? 1 : 0); }
    double period() const { return T; }
    unsigned int n_steps() const { return steps; }

    /// Motion without contact at a phase.
    std::vector<double> steady(double phase) const;
    /// The same without modes that their resonance makes 10,000 times larger than at rest: such a motion would hit the
    /// stop so fast that the steps of its first contact have no end.
    std::vector<double> steady_off_resonance(double phase) const;

    /// State after `periods` from the state x at a phase. @param variation n_states square, set to the derivative of
    /// the result with respect to x; null: not wanted. @param orbit appended to; null: not wanted
    /// @throws ConvergenceError if events do not stop following each other
    std::vector<double> advance(const std::vector<double> &x, double phase, double periods = 1,
                                DenseMatrix *variation = nullptr, Orbit *orbit = nullptr) const;

    /// @param phase of the orbit's period, any real number
    MotionSample at(const Orbit &orbit, double phase) const;
    /// Calls with weight [s] and sample for Gauss points of all pieces.
    void integrate(const Orbit &orbit, const std::function<void(double, const MotionSample &)> &add) const;

    /// (rms of w q and q') for errors of states: sqrt(sum) [sqrt(J)]; w at least that of the force
    double norm(const std::vector<double> &x) const;

  private:
    /// Answers over a contact step of one length.
    struct Step
    {
      double length;
      /// at the Gauss points
      std::vector<ForceAnswer> nodes;
      ForceAnswer end;
      /// drive at the Gauss points by state, s x n_states [1]; by force, s square [m/N]; for linear laws the forces by
      /// the drive
      DenseMatrix by_state, by_force, inverse;
      /// state at the end by force (subtracted), n_states x s
      DenseMatrix state_by_force;
    };
    using State = std::vector<double>;

    std::unique_ptr<Step> make_step(double length) const;
    void move_free(const std::vector<FreeMode> &modes, double relaxation, double t, State &x) const;
    void free_flight(double t, State &x) const;
    double tip(const State &x, double t) const;
    double tip_rate(const State &x, double t) const;
    double drive(const State &x, double t) const;
    double drive_rate(const State &x, double t) const;
    double force_of_drive(double e) const;
    void contact_step(const Step &step, double t, State &x, State &f) const;
    const Step &step_of_level(unsigned int level) const;
    /// last two Legendre coefficients of a force over its largest value
    double roughness(const State &f) const;
    void vary_free(double t, DenseMatrix &variation) const;
    void vary_contact(const Step &step, const State &f, DenseMatrix &variation) const;
    void follow_stop(double t, State &x) const;
    void vary_follow_stop(DenseMatrix &variation) const;
    bool flight(double &t, double end, bool fresh, State &x, Orbit *orbit) const;
    bool contact(double &t, double end, unsigned int &level, State &x, DenseMatrix *variation,
                 Orbit *orbit) const;
    MotionSample sample(double t, const State &deviation, double force, bool in_contact) const;

    const ForcedBody body;
    const std::shared_ptr<const NormalLaw> law;
    /// of the law at touch [m/N]
    const double touch_compliance;
    const HarmonicForce force;
    const unsigned int n, steps;
    const double accuracy;
    const GaussRule rule;
    double T, Omega, gap, S, beta = 0;
    /// r is a state; it follows the stop in contact
    bool relaxed = false, slaved = false;
    /// answers to s(t), Im(. e^(j Omega t)): modes, residual, contact point, drive e
    std::vector<std::complex<double>> Q;
    std::complex<double> R, U, E;
    /// to constant loads
    std::vector<double> q_load;
    double r_load = 0, u_load = 0, e_load = 0, rigid_load = 0;
    std::unique_ptr<Step> full;
    /// of T / n_steps / 2^(k + 1), made when they are needed
    mutable std::vector<std::unique_ptr<Step>> finer;
  };
} // namespace vibrocontact
