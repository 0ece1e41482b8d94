#pragma once

#include <vibrocontact/scene/road_profile.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Height of the road under each contact point in time:
  ///
  ///   u_r,i(t) = r(t) [indentation + z(s(t) + x_i)] - shape_i,      s(t) = int_0^t V dt
  ///   r(t) = (1 - cos(pi t / T)) / 2 up to the loading time T, then 1 (T = 0: 1)
  ///
  /// x_i: place of the point [m], forward; shape_i: height of body 1's surface there when it is undeformed [m].
  /// The contact opens where the body's displacement u_i exceeds u_r,i.
  ///
  /// z: RoadProfile.
  ///
  /// A kink of the profile (and a step of the speed) is a step of the rates of u_r, a step of the profile one of u_r. They
  /// are found in expressions (numerics/chebyshev_fit.h) and known of tables; before() and after() are the limits there.
  class Road
  {
  public:
    /// @param places, shapes [m], one per contact point; @param end_time the road has to reach [s]
    /// @throws InputError if it does not, or an entry cannot be read. Collective.
    Road(const RoadParameters &parameters, const std::vector<double> &places,
         const std::vector<double> &shapes, double end_time);

    /// u_r with its two derivatives in time [m, m/s, m/s^2]
    PiecewisePolynomial::Value at(unsigned int point, double t) const;
    /// The same at next_jump(), from before and from after it.
    PiecewisePolynomial::Value before(unsigned int point, double t) const;
    PiecewisePolynomial::Value after(unsigned int point, double t) const;
    double height(unsigned int point, double t) const;
    /// of one point at n ascending times [m]
    void heights(unsigned int point, const double *t, unsigned int n, double *result) const;
    /// All points at once [m]; n_points.
    void heights(double t, double *result) const;
    unsigned int n_points() const { return places.size(); }
    /// of the contact points over the road [m/s]
    double sliding_speed() const { return sliding; }
    /// that it is travelled along with, where it is constant [m/s]
    double rolling_speed() const { return speed; }
    /// The next time > t at which the height of some point, its rate or acceleration may jump (a break of the profile, of
    /// the speed, the end of the loading); infinite if there is none.
    double next_jump(double t) const;
    /// The next time > t at which a point meets a step upwards; infinite if there is none.
    double next_step_up(unsigned int point, double t) const;
    /// Where the profile has no finite slope, its entry in front; empty if it is smooth but for steps and kinks.
    const std::string &singular() const { return profile.singular_place; }
    /// Whether the profile is not flat.
    bool has_profile() const { return !profile.height.empty(); }
    /// z(s(t) + x_i), without loading, indentation and shape [m]
    double profile_height(unsigned int point, double t) const;
    /// [m]
    double distance(double t) const { return travelled.empty() ? speed * t : travelled.value(t); }

  private:
    void make_speed(const RoadParameters &parameters, double end_time);
    double loading(double t) const;
    void find_steps();
    double time_of(const std::vector<double> &positions, unsigned int point, double t) const;
    PiecewisePolynomial::Value side(unsigned int point, double t,
                                    PiecewisePolynomial::Value (PiecewisePolynomial::*of)(double) const,
                                    bool is_loaded) const;

    const std::vector<double> places, shapes;
    const double speed, indentation, loading_time, sliding;
    RoadProfile profile;
    /// empty: constant speed
    PiecewisePolynomial travelled;
    /// ascending [s]
    std::vector<double> jumps;
    /// where the profile steps up, ascending [m]
    std::vector<double> steps_up;
  };
} // namespace vibrocontact
