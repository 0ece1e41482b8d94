#pragma once

#include <vibrocontact/analyses/periodic/force_step.h>
#include <vibrocontact/analyses/periodic/massless_points.h>

#include <complex>
#include <map>
#include <vector>

namespace vibrocontact
{
  /// A period of a body whose contact points have no mass and stick and slip on their residual flexibility S before rigid
  /// stops (massless_points.h), in time, with its derivative. Modes move exactly between nodes of time, about their motion
  /// without contact; at a node their motion w and the places u of the node before give the forces p,
  ///
  ///   u = w + S p,   dp = (dp/dw) dw + (dp/du_before) du_before,   q' += t^T p (half of both intervals beside the node)
  ///
  /// State: deviations q, q' of the modes from the motion without contact, and u at the node before, which friction remembers.
  ///
  /// Nodes are the samples of the period near a contact. Where the status of a point changes from one to the next they are
  /// `parts` times as dense: a tangent that changes at a node is off by its interval, and friction takes out of a motion what
  /// hangs on when stick begins. Elsewhere the rule is of second order in the interval.
  class SlipMap
  {
  public:
    /// The period begins half an interval before the sample `first`, best in flight.
    /// @param friction coefficient of each point [-] @param phase of sample 0 after the force's rise through zero [-]
    /// @throws ConvergenceError if the samples are too few for the fastest motion in contact
    SlipMap(const ForcedBody &body, const std::vector<double> &friction, const HarmonicForce &force,
            unsigned int n_samples, double phase, unsigned int first, unsigned int parts = 32);

    /// whether impulses at so many samples follow a stiffness 1 / S on the modes, which they do up to 2 / interval
    static bool resolves(const ForcedBody &body, double frequency, unsigned int n_samples);

    unsigned int n_states() const { return 2 * n + rows; }
    /// where a period begins [-]
    double begin() const { return phase + (first - 0.5) / count; }
    /// Statuses of the points at the samples, row after row, which the next period is expected to have.
    void expect(const std::vector<ContactStatus> &given) { status = given; }
    /// Of the motion without contact: modes' displacements and velocities at a phase.
    std::vector<double> without_contact(double at_phase) const;

    /// The state after a period and its derivative by the state before, which costs most; null: not wanted. Statuses are then
    /// those of this period.
    /// @return false if a node found no solution
    bool advance(std::vector<double> &x, DenseMatrix *X);
    /// whether the last period changed status where its nodes were dense
    bool was_expected() const { return as_expected; }

    /// of modes, sqrt(sum (w q)^2 + q'^2)
    double size(const std::vector<double> &x) const;

  private:
    void fly(double t, std::vector<double> &x, DenseMatrix *X);
    bool meet(double at_phase, double interval, std::vector<double> &x, DenseMatrix *X);
    void vary(double interval, DenseMatrix &X);

    const ForcedBody body;
    const HarmonicForce force;
    const unsigned int n, rows, n_points, count, first, parts;
    const double phase;
    MasslessPoints points;
    /// answers to the exciting force: modes, rows
    std::vector<std::complex<double>> mode_answer, row_answer;
    std::vector<double> mode_rest, row_rest;
    std::map<double, std::vector<FreeMode>> flights;
    std::vector<ContactStatus> status, here;
    bool as_expected = true;
    /// work space
    std::vector<double> w, p, rates;
    DenseMatrix by_w, by_p;
  };

  struct SlipMultipliers
  {
    /// the largest first
    std::vector<std::complex<double>> values;
    /// change of the state from the motion given to the one that repeats itself, relative; negative: it was not found, and
    /// the multipliers are those of the period that begins with the motion given
    double correction = -1;
  };
  /// Of the motion that repeats itself next to a state where the map begins, by Newton's method on the map with the derivative at
  /// that state. Small corrections alone are taken; near a fold there may be none.
  SlipMultipliers slip_multipliers(SlipMap &map, std::vector<double> state);
} // namespace vibrocontact
