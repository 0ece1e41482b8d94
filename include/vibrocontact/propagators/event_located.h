#pragma once

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/propagators/piece_series.h>
#include <vibrocontact/propagators/work_account.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// An impact or a release of one contact point.
  struct ContactEvent
  {
    /// [s]
    double time;
    unsigned int point;
    /// of an impact [N s]
    double impulse = 0;
  };

  void exchange(CheckpointFile &file, const std::string &name, std::vector<ContactEvent> &events);

  /// Exact motion of a body on few rigid contact points: no steps but from event to event.
  ///
  ///   z' = Lambda z + left q + load,  u = 2 Re right z,     q_i = 0 (open)  or  u_i = u_r,i (closed)
  ///
  /// With g(0) = 0 and G1 = g'(0) positive definite the motion between events is linear; on a piece of it displacements,
  /// forces and states are polynomials (propagators/piece_series.h). Their roots are the events (numerics/zero_crossing.h):
  ///
  ///   touch    gap_i = 0 from above:  inelastic impact  0 <= J perp v + G1 J - u_r' >= 0 over all points with gap 0,
  ///            z += left J; for one point J = (u_r' - v) / g'(0). Then the closed points are those with q > 0 in
  ///            0 <= q perp u'' - u_r'' >= 0: a touch with a negative force after it is an impact and an immediate release
  ///   release  q_i = 0 from above
  ///   kink     u_r' jumps at a closed point: upwards an impact with J as at a touch, downwards a release (v > u_r' after it)
  ///   step     u_r jumps: down at a closed point a release; up into a point an input error, as no finite J follows it
  ///
  /// What rounding leaves in u_i - u_r,i and its rate is removed after every piece, along left and Lambda left; with
  /// one pole this is the closed form. (doc/modal_convolution.md, event-located motion.)
  class EventLocated
  {
  public:
    /// Called between events; holds on [begin, end].
    struct Piece
    {
      double begin, end;
      const PieceSeries &series;
      const std::vector<char> &closed;
      double u(unsigned int i, double t) const;
      double q(unsigned int i, double t) const;
      /// Of one point at many times, which are overwritten.
      void values(unsigned int i, std::vector<double> &times, std::vector<double> &displacements,
                  std::vector<double> &forces) const;

    private:
      double place(const double t) const { return (t - series.begin()) / series.length(); }
    };
    using Observer = std::function<void(const Piece &)>;

    /// @param longest_piece h [s]; shortened where the fastest pole asks for it
    /// @throws InputError if the body has a residual flexibility, or g(0) is not zero, or g'(0) is not positive
    /// definite, or it begins inside the road, or the road has no finite slope somewhere
    EventLocated(const BodyInContact &model, const std::vector<std::complex<double>> &state, const Road &road,
                 double longest_piece);

    /// Moves to the time `end`. @throws ConvergenceError if events do not stop following each other; InputError if the road
    /// steps up into a point
    void advance(double end, const Observer &observe);

    /// Longest piece of a motion without events, 2 / |fastest pole| at most [s]
    double longest_piece() const { return piece; }
    double time() const { return now; }
    std::vector<ContactEvent> impacts, releases;
    /// of each point so far, impacts included [N s]
    std::vector<double> impulse;
    /// of the force of all points together between impacts, squared, over time [N^2 s]
    double square_integral = 0;
    /// `stored` is that of now
    const WorkAccount &work();
    void exchange(CheckpointFile &file);

  private:
    using Complex = std::complex<double>;

    void find_closed_forces(const std::vector<unsigned int> &candidates);
    void touch(const std::vector<unsigned int> &touching, double least_rate = 0);
    void pass_jump();
    void account(double x);
    void project();
    double first_touch(unsigned int i) const;
    double first_release(unsigned int i) const;
    void invert_closed();
    double displacement(unsigned int i, unsigned int order) const;
    /// gaps below it are rounding
    double smallest_gap() const;

    const BodyInContact &model;
    const Road &road;
    const unsigned int n, n_poles;
    /// longest, and that over which the road was smooth enough last
    double piece, smooth_length;
    /// g'(0), g''(0)
    DenseMatrix first, second;
    /// over the closed points, m square, by rows
    std::vector<double> closed_inverse;
    std::vector<Complex> z;
    double now = 0;
    /// largest so far [m], [m/s]; begin with what is small for a road
    double height_scale = 1e-3, rate_scale = 1e-6;
    std::vector<unsigned int> closed;
    std::vector<char> is_closed, just_open;
    /// events so far without time between them
    unsigned int stuck = 0;
    PieceSeries series;
    ModalEnergy modes;
    WorkAccount account_so_far;
    std::vector<Complex> inner;
  };
} // namespace vibrocontact
