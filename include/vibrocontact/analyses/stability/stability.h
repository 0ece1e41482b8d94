#pragma once

#include <vibrocontact/analyses/stability/derivative_parameters.h>
#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <memory>
#include <optional>

namespace vibrocontact
{
  /// `subsection Stability`
  struct StabilityParameters
  {
    /// what moves: "reduced" (modes, and residual flexibility without inertia), "attachment inertia" (modes,
    /// and residual attachment modes), "finite elements"
    std::string model = "reduced";
    bool is_reduced() const { return model == "reduced"; }
    /// what stands for the loss of elements and of modes damped by number: "viscous", the diagonal of its projection on the
    /// modes as damping ratios; "hysteretic", see HystereticLoss
    std::string loss = "viscous";
    bool is_hysteretic() const { return loss == "hysteretic"; }
    /// "all", complete; "of body 1": those near modes of body 1 and of its dampers, with what all else answers kept from one
    /// variant of its dampers to the next (coupled_bodies/body_roots.h)
    std::string roots = "all";
    bool are_of_body_1() const { return roots == "of body 1"; }
    /// "consistent": all of the step's equations linearised; "paper": K_c and C_b of Lai et al. 2018, Eqs
    /// 19-22
    std::string linearisation = "consistent";
    bool is_consistent() const { return linearisation == "consistent"; }
    /// of the paper's linearisation: C_b and the convective part of the perturbed slip
    bool lateral_damping = true, convection = false;
    /// roots to be listed of finite elements that are too many for LAPACK
    unsigned int n_roots = 20;
    /// roots beyond it are counted, not listed [Hz]; 0: all are listed
    double upper_frequency = 0;
    /// take sticking points as stuck instead of refusing them
    bool stick = false;
    /// count the unstable roots by the argument principle as well, see count_unstable_roots()
    bool second_count = false;
    /// of a sweep: "complete", all roots of each case; "followed", see followed_row()
    std::string roots_of_sweep = "complete";
    bool follows() const { return roots_of_sweep == "followed"; }
    DerivativeParameters derivatives;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
    LinearisationOptions options() const;
  };

  /// A rolling equilibrium and its roots.
  struct StabilityResult
  {
    RollingCase rolling_case;
    unsigned int contact_points = 0, stick_points = 0;
    /// [N]; displacement of the hub [m]
    double normal_force = 0, approach = 0;
    /// of each contact at the equilibrium
    std::vector<ContactResultants> contacts;
    /// RollingParameters::hub
    std::string hub;
    /// the pair whose modes the shapes of the roots are amplitudes of, if that is another than the held one
    std::shared_ptr<const ContactPair> suspended;
    std::vector<StabilityRoot> roots;
    /// roots above StabilityParameters::upper_frequency, which are not among them, and how many of those grow
    unsigned int n_above = 0, n_growing_above = 0;
    /// whether they are some of all: those that a sweep follows
    bool followed = false;
    /// ContactPair::modes_reach [Hz]; infinite: another model than the reduced one
    double modes_reach = std::numeric_limits<double>::infinity();
    /// wall time of the eigenvalues [s]
    double seconds = 0;

    std::optional<RootCount> second_count;

    /// those that grow
    std::vector<const StabilityRoot *> unstable() const;
    /// Moves the roots above a frequency [Hz] from `roots` to the counts.
    /// @throws ConvergenceError if none is left
    void leave_out_above(double frequency);
    /// the root with the largest divergence rate of those that the modes kept carry: how near the next instability is
    const StabilityRoot &nearest() const;

    /// all but `suspended`
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &rolling_case &contact_points &stick_points &normal_force &approach &contacts &hub;
      archive &roots &n_above &n_growing_above &followed &modes_reach &seconds;
      bool has_second_count = second_count.has_value();
      archive &has_second_count;
      if (has_second_count)
        archive &(second_count ? *second_count : second_count.emplace());
    }
  };

  /// Told of a case that has no equilibrium or no roots, in a sentence.
  using FailedCase = std::function<void(const std::string &)>;

  /// The rolling equilibria of section Rolling as stability takes them: `found` gets each with a result that has all but roots.
  /// @param A rolling_operator() of the pair at that speed, which many calls on one pair share; null: made here
  /// @param failed is told of those that do not converge; null: ConvergenceError is thrown
  void stability_equilibria(const RollingParameters &rolling, const ContactSections &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const std::shared_ptr<const ContactOperator> &A,
                            const std::function<void(StabilityResult &&, const RollingEquilibrium &)> &found,
                            const FailedCase &failed = {});
  std::shared_ptr<const ContactOperator> operator_of_stability(const ContactPair &pair,
                                                               const ContactSections &contact, double speed);

  /// The roots of another model about an equilibrium.
  using RootFinder = std::function<std::vector<StabilityRoot>(const RollingEquilibrium &)>;

  /// Complex eigenvalues about each rolling equilibrium of section Rolling (its sweep included), with the hub as
  /// RollingParameters::hub says, on the modes
  /// of the pair, or by `roots_about` unless that is empty. The equilibria are those of the pair in any case:
  /// all models have the same static compliance.
  /// @param loss of the pair; null: its damping ratios are all that damps
  /// @param failed is told of cases that come to nothing, which are not among the results; null: ConvergenceError is thrown
  /// @throws InputError if an equilibrium is not in full sliding and sticking points are not asked for
  std::vector<StabilityResult> stability(const StabilityParameters &parameters,
                                         const RollingParameters &rolling, const ContactSections &contact,
                                         const ContactSolverParameters &solver, const ContactPair &pair,
                                         const std::function<void(const StabilityResult &)> &finished,
                                         const RootFinder &roots_about = {},
                                         const HystereticLoss *loss = nullptr, const FailedCase &failed = {});
} // namespace vibrocontact
