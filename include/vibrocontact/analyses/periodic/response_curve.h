#pragma once

#include <vibrocontact/analyses/periodic/stability.h>
#include <vibrocontact/numerics/continuation.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// How a branch of periodic motions is followed.
  struct BranchSettings
  {
    SceneParameter parameter = SceneParameter::frequency;
    /// begin, from the motion that PeriodicBalance::solve() finds there, and limits; in the parameter's unit
    double start = 0, least = 0, most = 0;
    /// -1: towards smaller values
    int direction = 1;
    /// in the parameter's unit: one unit of arc length without contact; 0: a tenth of the range
    double scale = 0;
    /// arc lengths
    double first_step = 0.02, min_step = 1e-10, max_step = 0.1;
    unsigned int max_points = 5000;
    /// of folds and grazing, in the parameter's unit
    double location_tolerance = 1e-6;
    StabilityMethod stability = StabilityMethod::monodromy;
    /// modes of the stability analysis: up to so many times the frequency; the others are static
    double mode_limit = 20;
    unsigned int hill_harmonics = 31;
  };

  /// A periodic motion of a branch.
  struct BranchPoint
  {
    CurvePoint::Kind kind = CurvePoint::Kind::regular;
    /// of a fold: a turn that merge_folds() leaves out
    bool is_spurious = false;
    HarmonicForce excitation;
    /// of the first point [m]
    double gap = 0;
    /// largest |u| of the first contact point over the period [m]
    double amplitude = 0;
    /// part of the samples in contact, all points together
    double active = 0;
    /// multiplier of the largest modulus; 0 if stability was not asked for
    std::complex<double> multiplier = 0;
    /// of the parameter that a branch is followed in
    double value(SceneParameter parameter) const;
    bool is_stable() const { return std::abs(multiplier) <= 1 + 1e-6; }
    /// moments of the contact forces, for PeriodicBalance::solve()
    std::vector<double> force;
  };

  struct ResponseCurve
  {
    SceneParameter parameter;
    /// in order along the branch; folds and grazing among them
    std::vector<BranchPoint> points;
    Curve::End end = Curve::End::no_start;
    /// followed to a limit of the parameter or closed, and not all turns
    bool complete = false;
    std::string reason;
    /// points of the part from the first value if the curve is broken behind them; 0: it is whole
    unsigned int n_first = 0;
    /// values of the parameter; turns without amplitude or contact changing beside these folds
    std::vector<double> folds, grazing;
    unsigned int n_spurious = 0;
    bool has_stability = false;
    /// following the branch, its stability [s]
    double seconds = 0, stability_seconds = 0;

    bool is_whole() const { return end == Curve::End::parameter_limit || end == Curve::End::closed; }
  };

  /// Folds that follow on each other with the same amplitude and part of the period in contact are one: the samples of a stiff or
  /// rigid law come into contact one by one, and the curve is as rough as that. Of an odd number the outermost is kept, of an
  /// even one none. More than two of them spurious in a row: the curve is not complete.
  void merge_folds(ResponseCurve &curve);

  /// Branch of solutions of the balance through the motion at settings.start. The unknowns, moments of the contact forces,
  /// are scaled by the force that would close the gap at rest, at least the exciting force; without contact they are
  /// zero, so that arc length is the parameter alone. Grazing: largest displacement equal to the gap.
  /// @param balance with body, law and force; left at the end of the branch
  /// @throws InputError if stability is asked for with a rigid stop at a contact point with mass, or with friction at others
  /// than PeriodicBalance::slipping_points()
  ResponseCurve follow_response(PeriodicBalance &balance, const BranchSettings &settings);
} // namespace vibrocontact
