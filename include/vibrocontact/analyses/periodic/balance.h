#pragma once

#include <vibrocontact/analyses/periodic/condensation.h>
#include <vibrocontact/analyses/periodic/massless_contact.h>
#include <vibrocontact/analyses/periodic/time_sampling.h>
#include <vibrocontact/contact/contact_problem.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  class Progress;

  /// How a periodic motion is sought.
  struct BalanceSettings
  {
    std::string trial = "fourier", weighting = "fourier";
    unsigned int n_functions = 127;
    TimeForm form = TimeForm::distributional;
    /// samples of the contact law over the period; left points of the integrals, 0: exact
    unsigned int n_samples = 4096, quadrature_points = 0;
    /// coefficient of friction, the largest if points differ, and then of each; empty: they do not [-]
    double friction = 0;
    std::vector<double> friction_of_points = {};
    /// parameter of the projections over the largest compliance [-]
    double projection = 30;
    /// largest residual over the exciting force or the contact force [-]
    double tolerance = 1e-10;
    unsigned int max_iterations = 60;
    /// that `trial` and `weighting` are of; never null
    std::shared_ptr<const TimeBases> bases = std::make_shared<const TimeBases>(time_bases());
  };

  /// A periodic motion: moments of the contact forces and coefficients of the rows' motion, N numbers each in the layout
  /// of time_basis.h, row after row. Contact forces are compressions on normal rows, forces on the body on
  /// tangential ones.
  struct PeriodicSolution
  {
    std::vector<double> force, displacement;
    HarmonicForce excitation;
    bool converged = false;
    unsigned int iterations = 0;
    /// steps of the gap that the motion was followed over; 0: found directly
    unsigned int homotopy_steps = 0;
    /// steps of the law's stiffness, likewise
    unsigned int stiffness_steps = 0;
    double residual = 0;
  };

  /// What a branch of solutions may be followed in: frequency [Hz] and amplitude [N] of the exciting force, gap of the
  /// first point [m], to which those of the others keep their distance.
  enum class SceneParameter
  {
    frequency,
    force,
    gap
  };

  /// Periodic motion in contact as one equation in the moments c of the contact forces,
  ///
  ///   R(c) = c - P law(L c, Q u(c), f Q' u(c)) = 0,     u = linear + H p(c)
  ///
  /// Q, Q': samples of trial functions and their derivatives, L: of the force from its moments, P: moments of
  /// samples. A law that is a function of the gap (penalty, linear spring) needs no L c; for it R is the paper's
  /// equation (17) condensed onto the contact. Signorini's law and Coulomb's are their projections,
  ///
  ///   max(N + r (u_n - gap_0), 0),      Proj_disc(mu N) (T - r v)
  ///
  /// at each sample: a dynamic Lagrangian whose unknowns are the forces of the N functions. Newton's method (semi-smooth:
  /// the derivative on the side of the law's branch in force) with a line search.
  class PeriodicBalance
  {
  public:
    /// @throws InputError for an inadmissible pair, a body or settings that do not fit the law
    /// @throws ConvergenceError if the last order of even N has neither stiffness nor damping (Haar against splines)
    PeriodicBalance(const ForcedBody &body, const PointLaws<NormalLaw> &law, const BalanceSettings &settings);

    /// Condenses the body at this force. Cheap: n_modes n_rows^2 N.
    void set_force(const HarmonicForce &force);
    void set_gap(const std::vector<double> &gap) { body.gap = gap; }
    void set(SceneParameter parameter, double value);
    /// Parameter of the normal projections, whatever the force from now on [N/m]; 0: by BalanceSettings::projection. Solutions
    /// depend on it within the error of the functions.
    void set_projection(const double rho)
    {
      fixed_rho = rho;
      set_force(force);
    }
    /// Replaces the modes of the body by receptances of any kind, for example those of the continuous bar.
    void set_condensation(std::function<CondensedBody(const HarmonicForce &)> receptances);

    /// R, dR/dc and the derivative with respect to a parameter; null: not wanted.
    void evaluate(const std::vector<double> &c, std::vector<double> &residual, DenseMatrix *jacobian,
                  std::vector<double> *by_parameter, SceneParameter parameter = SceneParameter::frequency);

    /// Of the last c that was evaluated: displacement of a row at the samples [m]; a number that changes with the sets of samples
    /// in contact and of those that stick; how many are in contact.
    const double *row_samples(const unsigned int row) const { return &u_samples[row * samples->n_samples()]; }
    std::size_t active_pattern() const;
    unsigned int n_active() const;
    /// Tangent stiffness of a point's law around each sample [N/m], first touch and release placed between samples by the
    /// gap; of a rigid stop `rigid` where it carries force.
    std::vector<double> contact_stiffness(unsigned int point, double rigid) const;
    /// Derivatives of a point's normal law at the samples that the Jacobian is made of: by the displacement towards the stop
    /// [N/m] and by the force [-].
    std::array<std::vector<double>, 2> normal_tangent(unsigned int point) const;

    /// Logarithm of the modulus and sign of det R_c for small motions that are periodic but for a factor e^(lambda t), lambda real,
    ///
    ///   det[ 1 - P dlaw/dc L - D(lambda) H(lambda) sign ] prod_n prod_m |d_n(m, lambda)|
    ///
    /// with its poles taken out. Zeros are the real positive Floquet multipliers e^(lambda T) of the balance's own
    /// tangents; at lambda = 0 it is zero where R_c is singular, at folds. D are the tangents of the law with its P and Q; only
    /// points with a history feel lambda in them. Of the last c that was evaluated; without friction, or at points without mass.
    std::function<std::pair<double, int>(double)> growth_determinant() const;
    /// The last c that was evaluated; statuses there at the samples of each point, row after row.
    const std::vector<double> &last_force() const { return evaluated; }
    const std::vector<ContactStatus> &point_status() const { return status; }
    /// The points without mass that stick and slip, if they are of that kind; or null.
    const MasslessContact *slipping_points() const { return massless.get(); }

    /// From c, or if c is empty from the motion without contact; at several points, whose gaps may close at nearly the same time,
    /// and where points without mass stick and slip, from the motion of half as many functions. If Newton's method fails from
    /// there, the motion is followed from a gap that it just does not touch; if that fails too, for laws that are functions of
    /// the gap, from a soft one. Never throws for want of convergence: see `converged`.
    PeriodicSolution solve(const std::vector<double> &start = {});

    unsigned int n_unknowns() const { return body.n_contact_rows() * settings.n_functions; }
    /// coefficients of the rows' motion under the contact forces c
    std::vector<double> displacement(const std::vector<double> &c) const;
    /// forces on the body: normal rows of c change sign
    std::vector<double> body_forces(const std::vector<double> &c) const;

    /// The law of a point at one sample: force of its rows from their forces in the basis, the gap and the physical
    /// velocities of the tangential rows.
    std::array<double, 3> contact_force(unsigned int point, const std::array<double, 3> &force, double gap,
                                        const std::array<double, 3> &velocity) const;

    /// scale of residuals [N]
    double force_scale(const std::vector<double> &c) const;

    const ForcedBody &linear_body() const { return body; }
    const NormalLaw &normal_law(const unsigned int point) const { return law[point]; }
    /// Whether the forces of all points are functions of their gaps.
    bool is_spring() const { return spring; }
    /// Coefficient of friction of a point [-].
    double friction_of(const unsigned int point) const
    {
      return settings.friction_of_points.empty() ? settings.friction : settings.friction_of_points[point];
    }
    const TimePairing &integrals() const { return pairing; }
    const TimeBasis &trial() const { return *trial_basis; }
    const TimeBasis &weighting() const { return *weighting_basis; }
    const TimeSampling &sampling() const { return *samples; }
    const CondensedBody &condensed() const { return linear; }
    const HarmonicForce &excitation() const { return force; }
    const BalanceSettings settings;

  private:
    void displacement_from(const std::vector<double> &c, const std::vector<std::complex<double>> &linear_part,
                           const std::vector<std::complex<double>> &compliance, std::vector<double> &u) const;
    /// Samples of the law at c and of its derivatives; what the next three work with.
    void apply_law(const std::vector<double> &c);
    void apply_massless(const std::vector<double> &c);
    void residual_of(const std::vector<double> &c, std::vector<double> &residual) const;
    void assemble(DenseMatrix &jacobian);
    /// 1 - P dlaw/dc L less the one, and D of growth_determinant() at lambda = 0
    void assemble_law(DenseMatrix &by_force, DenseMatrix &by_motion) const;
    /// of the forces' moments by the coefficients of w
    DenseMatrix massless_rates(double growth) const;
    /// adds 1 - by_motion H sign, compliance H of the rows' motion less what massless points answer
    void add_answer(const DenseMatrix &by_motion, const std::vector<std::complex<double>> &compliance,
                    DenseMatrix &jacobian) const;
    void slope_of(const std::vector<double> &slope, bool in_frequency, std::vector<double> &by_parameter);
    /// derivative of the rows' coefficients at fixed c
    std::vector<double> motion_slope(const std::vector<double> &c, SceneParameter parameter) const;
    CondensedBody condensed_at(const HarmonicForce &at) const;
    bool find(std::vector<double> &c, PeriodicSolution &solution);
    class Equations;
    bool newton(std::vector<double> &c, PeriodicSolution &solution);
    bool refine_fewer_functions(std::vector<double> &c, PeriodicSolution &solution);
    std::vector<double> linear_excess() const;
    bool follow_gap(std::vector<double> &c, PeriodicSolution &solution);
    bool follow_stiffness(std::vector<double> &c, PeriodicSolution &solution);
    /// of a law that is a function of the gap: nothing where it is open
    NormalLaw::GraphPoint over_gap(const unsigned int point, const double gap) const
    {
      return gap < 0 ? law[point].graph(-gap) : NormalLaw::GraphPoint{0., 0., 0., 1.};
    }
    bool is_normal(const unsigned int row) const { return row % body.rows_per_point == 0; }
    double sign(const unsigned int row) const { return is_normal(row) ? -1. : 1.; }

    /// of solve(), while it lasts
    Progress *progress = nullptr;
    ForcedBody body;
    const PointLaws<NormalLaw> law;
    /// whether the laws of all points give the force over the gap
    const bool spring;
    std::unique_ptr<const TimeBasis> trial_basis, weighting_basis;
    TimePairing pairing;
    std::unique_ptr<TimeSampling> samples;
    HarmonicForce force;
    std::function<CondensedBody(const HarmonicForce &)> receptances;
    CondensedBody linear;
    /// of the projections [N/m], [N s/m]
    double normal_rho = 0, tangential_rho = 0, fixed_rho = 0;
    /// of the forces of a law that is a function of the gap: its stiffness grows with it [-]
    double law_factor = 1;
    /// tangential rows that no force moves: they carry none
    std::vector<char> is_inert;
    // work space: coefficients and samples of the rows; derivatives of the law by point and pair of its rows
    std::vector<double> evaluated, u, u_samples, v_samples, c_samples, law_samples, by_u, by_v, by_c;
    DenseMatrix by_displacement;
    /// of each point's samples
    std::vector<ContactStatus> status;
    /// with friction before a rigid stop and residual flexibility without relaxation: forces follow from the motion of
    /// the modes alone; values of the trial functions and weights of the moments at the samples
    std::unique_ptr<MasslessContact> massless;
    DenseMatrix trial_values, moment_weights;
    std::vector<double> modal_samples;
    /// the same balance with half as many functions, made when solve() needs it
    std::unique_ptr<PeriodicBalance> fewer;
  };
} // namespace vibrocontact
