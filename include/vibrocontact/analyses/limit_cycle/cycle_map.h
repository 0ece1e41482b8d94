#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_balance.h>
#include <vibrocontact/analyses/limit_cycle/cycle_coordinates.h>
#include <vibrocontact/marching/transient_parameters.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace vibrocontact
{
  class Progress;

  /// The contact solver of a map whose cycle is sought: what the steps of a period leave adds up, and has to stay below the tolerance
  /// of a cycle.
  ContactSolverParameters solver_of_cycles(ContactSolverParameters solver);

  /// The march of the transient over one period T in m equal steps, as a map of the state that it starts from, and its derivative.
  ///
  /// The state is that of CycleCoordinates, with rates if the residual theta is below 1. m is fixed, so that h = T / m changes with T.
  class CycleMap
  {
  public:
    /// Called after every step.
    using Observer = std::function<void(const DynamicState &)>;

    /// All are referred to. @param solver of a step's contact, see solver_of_cycles() @param drive constant, at a given approach or
    /// normal force
    /// @param approach at rest, from which the steps start to look for theirs if the force is given [m]
    /// @param points of the grid that may touch, ascending, see points_around()
    /// @param shapes shapes_of_steps() of the pair; null: they are found
    CycleMap(const TransientParameters &transient, const ContactSections &contact,
             const ContactSolverParameters &solver, const ContactPair &pair, const Drive &drive,
             double approach, const std::vector<unsigned int> &points, unsigned int n_steps,
             std::shared_ptr<const PatchShapes> shapes = nullptr);

    const std::vector<unsigned int> &points_that_may_touch() const { return points; }
    unsigned int size() const { return coordinates.size(); }
    /// of these, modes and poles, which stand first
    unsigned int n_motion() const { return coordinates.n_motion(); }
    unsigned int n_steps() const { return m; }
    /// Of a motion of a frequency [Hz], see there [1/s].
    double growth_taken_by_theta(double frequency) const;
    /// V [m/s]
    double speed() const { return drive.creepage.speed; }
    DenseVector pack(const DynamicState &state) const { return coordinates.pack(state); }
    DynamicState unpack(const DenseVector &x) const;
    /// Whether only the points are loaded. @param R 3 n of the whole grid
    bool are_known(const DenseVector &R) const;

    /// The state after a period; that of the last march if it began there. @param keep_derivatives for derivative()
    /// @throws ConvergenceError where a step does not converge
    DenseVector march(const DenseVector &x, double period, bool keep_derivatives,
                      const Observer &observe = {});
    /// Statuses of all points at the ends of the steps of the last march, which kept its derivatives.
    const std::vector<std::vector<ContactStatus>> &statuses() const { return marched.statuses; }
    // of the last march, rate() of any and the others of one that kept its derivatives:
    /// What a change of the start makes of the end.
    DenseVector derivative(const DenseVector &start) const;
    /// Derivative of the end by the period [sqrt(J)/s].
    DenseVector by_period() const;
    /// |Phi_x r - r| / |r|, r: Phi_x times rate(). A disturbance along the motion stays what it is, if the steps are short enough.
    double change_along_motion() const;
    /// The derivative by all of the start that the motion depends on and that lasts a period (CycleCoordinates), square. Its eigenvalues
    /// are those of the derivative by the state, but for zeros.
    DenseMatrix monodromy() const;
    /// rate() in terms of the monodromy matrix [sqrt(J)/s].
    DenseVector rate_of_lasting() const;
    /// Mean change of the state over the first and the last step of the last march, over their length [sqrt(J)/s]: how a motion
    /// that repeats itself goes on.
    const DenseVector &rate() const { return mean_rate; }
    /// The derivative of one step of h [s] that starts from a state, square. @throws ConvergenceError
    DenseMatrix one_step(const DynamicState &state, double step) const;

    /// The same motion by harmonics of the contact forces. @param at_rest is referred to, as the map itself
    CycleBalance balance(const DynamicState &at_rest, unsigned int n_harmonics, double tolerance) const;

    /// that of the search, which says how many steps were marched; null: nobody hears of them
    Progress *progress = nullptr;
    /// whether a contact was found outside of the points
    bool left_its_points = false;
    /// steps that were marched so far, and columns that derivatives were multiplied with
    unsigned long n_marched_steps = 0;
    mutable unsigned long n_products = 0;

  private:
    /// From now on derivatives are on the points in contact at some time of the march.
    void stand_on_loaded_points();
    /// Of the last march. @throws ConvergenceError if one of its steps has none, or nothing was in contact
    const std::vector<StepDerivative> &derivatives_of_steps() const;
    std::unique_ptr<ContactStepper> stepper_of(double step) const;

    const TransientParameters &transient;
    const ContactSections &contact;
    ContactSolverParameters solver;
    const ContactPair &pair;
    const Drive drive;
    const double approach;
    const std::vector<unsigned int> points;
    const std::shared_ptr<const PatchShapes> shapes;
    const CycleCoordinates coordinates;
    const unsigned int m;
    /// of loads that stay, on modes and poles
    DenseVector constant_force;
    std::vector<std::complex<double>> constant_feed;
    /// the last march, so that it is not made twice
    struct March
    {
      double period = 0;
      DenseVector start, end;
      bool has_derivatives = false;
      std::vector<std::vector<ContactStatus>> statuses;
    };
    March marched;
    std::unique_ptr<ContactStepper> stepper;
    std::unique_ptr<StepOnPoints> loaded;
    std::vector<StepDerivative> derivatives;
    /// why they are not there; empty: they are, or were not asked for
    std::string no_derivative;
    std::vector<StepEnds> ends;
    std::vector<ModalStep> modes_by_length;
    StepWeights poles_by_length;
    DenseVector mean_rate;
  };

  /// Forces of the points that may touch, 3 n_points each, and approaches at the ends of the steps of a period.
  struct CycleForces
  {
    std::vector<unsigned int> points;
    std::vector<DenseVector> forces;
    std::vector<double> approaches;
  };
  CycleForces forces_of_period(CycleMap &map, const DenseVector &state, double period);

  /// How far a contact may spread beyond its points at rest, columns and rows of the grid: tried one after the other, the whole grid last.
  constexpr unsigned int spreads_of_contact[] = {1, 4, std::numeric_limits<unsigned int>::max() / 2};

  /// Points that carry load, and their neighbours up to so many columns and rows of their grid away; ascending.
  std::vector<unsigned int> points_around(const PlacedContacts &contacts, const DenseVector &R,
                                          unsigned int distance);
} // namespace vibrocontact
