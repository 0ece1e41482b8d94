#pragma once

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/reduction/pole_model.h>
#include <vibrocontact/scene/road.h>

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
  /// Closed points, with g(0) = 0 and G1 = g'(0) positive definite: two derivatives of u_i = u_r,i give
  ///
  ///   q_C = G1_CC^-1 (u_r'' - 2 Re right (lambda^2 z + lambda load))_C
  ///
  /// and thus a linear motion. On a piece of length tau <= h its Taylor series is summed to rounding, with u_r''
  /// interpolated in Chebyshev points; gaps, forces and the states at any time in it are polynomials. Their roots are
  /// the events:
  ///
  ///   touch    gap_i = 0 from above:  inelastic impact  0 <= J perp v + G1 J - u_r' >= 0 over all points with gap 0,
  ///            z += left J; for one point J = (u_r' - v) / g'(0). Then the closed points are those with q > 0 in
  ///            0 <= q perp u'' - u_r'' >= 0: a touch with a negative force after it is an impact and an immediate release
  ///   release  q_i = 0 from above
  ///
  /// What rounding leaves in u_i - u_r,i and its rate is removed after every piece, along left and Lambda left; with
  /// one pole this is the closed form. (doc/modal_convolution.md, event-located motion.)
  class EventLocated
  {
  public:
    /// Called between events with functions of the time that hold on [begin, end]; displacement and force of a point.
    struct Piece
    {
      double begin, end, length;
      /// coefficients of the powers of (t - begin) / length; n_rows each
      const std::vector<std::vector<double>> &displacement, &force;
      double u(unsigned int i, double t) const { return horner(displacement[i], (t - begin) / length); }
      double q(unsigned int i, double t) const { return horner(force[i], (t - begin) / length); }
      static double horner(const std::vector<double> &c, double x);
    };
    using Observer = std::function<void(const Piece &)>;

    /// @param longest_piece h [s]; shortened where the fastest pole asks for it
    /// @throws InputError if the body has a residual flexibility, or g(0) is not zero, or g'(0) is not positive
    /// definite, or it begins inside the road
    EventLocated(const PoleModel &model, const std::vector<std::complex<double>> &state, const Road &road,
                 double longest_piece);

    /// Moves to the time `end`. @throws ConvergenceError if events do not stop following each other
    void advance(double end, const Observer &observe);

    double time() const { return now; }
    std::vector<ContactEvent> impacts, releases;
    /// of each point so far, impacts included [N s]
    std::vector<double> impulse;
    unsigned long n_pieces() const { return pieces; }
    void exchange(CheckpointFile &file);

  private:
    using Complex = std::complex<double>;

    /// false: the road is not smooth enough over that length
    bool expand(double length);
    void find_closed_forces(const std::vector<unsigned int> &candidates);
    void touch(const std::vector<unsigned int> &touching);
    void project();
    double first_touch(unsigned int i, double length) const;
    double first_release(unsigned int i) const;
    void invert_closed();
    double displacement(unsigned int i, unsigned int order) const;
    /// gaps below it are rounding
    double smallest_gap() const;

    const PoleModel &model;
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
    unsigned long pieces = 0;
    unsigned int n_orders = 0;
    /// events so far without time between them
    unsigned int stuck = 0;

    /// Taylor coefficients of the piece: states (order by order), then per row displacement and force
    std::vector<std::vector<Complex>> series;
    std::vector<std::vector<double>> u, q;
  };
} // namespace vibrocontact
