#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace vibrocontact
{
  using Complex = std::complex<double>;
  using Matrix2 = dealii::Tensor<2, 2, Complex>;

  namespace
  {
    const Complex j(0, 1);

    Matrix2 stiffness(const RingParameters &ring, const int n, const double rotation)
    {
      const RingParameters::Order L = ring.order(std::abs(n), rotation);
      const double coupling = n < 0 ? -L.coupling : L.coupling;
      Matrix2 result;
      result[0][0] = L.tangential;
      result[1][1] = L.radial;
      result[0][1] = -j * coupling;
      result[1][0] = j * coupling;
      return result;
    }

    // C + D_n; the root of a 2 x 2 matrix is (L + sqrt(det) I) / sqrt(trace + 2 sqrt(det))
    Matrix2 damping(const RingParameters &ring, const int n, const double rotation)
    {
      Matrix2 result = stiffness(ring, n, 0);
      const double root = std::sqrt(std::max(0., ring.order(std::abs(n)).determinant())),
                   m = ring.line_density(),
                   factor = 2 * ring.damping_ratio *
                            std::sqrt(m / (result[0][0].real() + result[1][1].real() + 2 * root));
      for (unsigned int i = 0; i < 2; ++i)
        result[i][i] += root;
      result *= Complex(factor);
      result[0][1] += 2 * m * rotation;
      result[1][0] -= 2 * m * rotation;
      return result;
    }

    // (v, w) e^{j n theta} per unit force on a unit length of that shape; omega in the ring's frame
    Matrix2 order_receptance(const RingParameters &ring, const int n, const double rotation,
                             const double omega)
    {
      Matrix2 Z = stiffness(ring, n, rotation) + (j * omega) * damping(ring, n, rotation);
      for (unsigned int i = 0; i < 2; ++i)
        Z[i][i] -= omega * omega * ring.line_density();
      return dealii::invert(Z);
    }

    // rows in terms of (v, w)
    unsigned int component(const RingRow &row)
    {
      return row.tangential ? 0 : 1;
    }
    double sign(const RingRow &row)
    {
      return row.tangential ? 1 : -1;
    }

    // A pole of order n: shape (v, w) and what a force on (v, w) feeds into it
    struct Pole
    {
      Complex lambda;
      std::array<Complex, 2> right, left;
    };

    // The four poles of order n, by the imaginary part, from y = (q, q' / s): y' = s A y + (0, f / (m s))
    std::array<Pole, 4> poles_of_order(const RingParameters &ring, const unsigned int n,
                                       const double rotation)
    {
      const Matrix2 L = stiffness(ring, n, rotation), D = damping(ring, n, rotation);
      const double m = ring.line_density(), s = std::sqrt((L[0][0].real() + L[1][1].real()) / m);
      ComplexMatrix A(4, 4);
      for (unsigned int a = 0; a < 2; ++a)
      {
        A(a, a + 2) = 1;
        for (unsigned int b = 0; b < 2; ++b)
        {
          A(a + 2, b) = -L[a][b] / (m * s * s);
          A(a + 2, b + 2) = -D[a][b] / (m * s);
        }
      }
      const ComplexEigenvectors found =
          complex_eigenvectors(A, "poles of the ring in " + std::to_string(n) + " waves");
      std::array<Pole, 4> poles;
      for (unsigned int k = 0; k < 4; ++k)
      {
        poles[k].lambda = s * found.values[k];
        for (unsigned int c = 0; c < 2; ++c)
        {
          poles[k].right[c] = found.right(c, k);
          poles[k].left[c] = found.left(k, 2 + c) / (m * s);
        }
        check_decay(poles[k].lambda, n, s, rotation);
      }
      std::sort(poles.begin(), poles.end(),
                [](const Pole &a, const Pole &b) { return a.lambda.imag() < b.lambda.imag(); });
      return poles;
    }

    void check_held(const RingParameters &ring, const unsigned int n)
    {
      const RingParameters::Order L = ring.order(n);
      if (!(L.determinant() > 1e-12 * L.tangential * L.radial) || !(L.tangential > 0))
        throw InputError("Nothing holds the ring's motion in " + std::to_string(n) +
                         " waves: give it foundation stiffness or more inflation pressure.");
    }
  } // namespace

  double share_of_pair(const Complex &pole)
  {
    const bool is_real = std::abs(pole.imag()) < 1e-9 * std::abs(pole);
    return is_real ? 0.5 : pole.imag() > 0 ? 1. : 0.;
  }

  void check_decay(const Complex &pole, const unsigned int order, const double scale, const double rotation)
  {
    if (!(pole.real() < 1e-10 * scale))
      throw InputError("The ring turns at " + number_text(std::abs(rotation)) +
                       " rad/s, where its motion in " + std::to_string(order) +
                       (order == 1 ? " wave" : " waves") + " grows by " + number_text(pole.real()) +
                       " 1/s: lower the speed of rolling, or give the ring more foundation stiffness.");
  }

  std::vector<RingRow> ring_rows(const RingParameters &ring, const bool with_friction)
  {
    std::vector<RingRow> rows;
    for (const bool tangential : {false, true})
      for (const double angle : ring.angles())
        if (!tangential || with_friction)
          rows.push_back({angle, tangential});
    return rows;
  }

  BodyInContact ring_poles(const RingParameters &ring, const std::vector<RingRow> &rows,
                           const double rotation, const RingFrame frame)
  {
    BodyInContact model;
    std::vector<std::array<Complex, 2>> right, left;
    std::vector<unsigned int> order;
    for (unsigned int n = 0; n <= ring.highest_order; ++n)
    {
      check_held(ring, n);
      const auto poles = poles_of_order(ring, n, rotation);
      unsigned int branch = 0;
      for (Pole pole : poles)
      {
        const double weight = n == 0 ? share_of_pair(pole.lambda) : 1.;
        ++branch;
        if (weight == 0)
          continue;
        model.poles.push_back(frame == RingFrame::road ? pole.lambda - j * (n * rotation) : pole.lambda);
        for (Complex &value : pole.left)
          value *= weight / (2 * dealii::numbers::PI * ring.radius);
        right.push_back(pole.right);
        left.push_back(pole.left);
        order.push_back(n);
        model.labels.push_back("n=" + std::to_string(n) + ", branch " + std::to_string(branch));
      }
    }
    model.right.reinit(rows.size(), right.size());
    model.left.reinit(rows.size(), right.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (unsigned int k = 0; k < right.size(); ++k)
      {
        const Complex phase = std::polar(1., order[k] * rows[i].angle);
        model.right(i, k) = sign(rows[i]) * right[k][component(rows[i])] * phase;
        model.left(i, k) = sign(rows[i]) * left[k][component(rows[i])] * std::conj(phase);
      }
    model.pole_load.assign(model.poles.size(), 0.);
    model.residual = ring_rest(ring, rows, rotation, frame);
    return model;
  }

  void add_gradient(BodyInContact &body, const RingParameters &ring, const double rotation,
                    const std::vector<double> &difference)
  {
    const unsigned int n = ring.n_points;
    std::vector<RingRow> rows = ring_rows(ring, true);
    AssertThrow(body.n_rows() == rows.size() && rotation != 0, dealii::ExcInternalError());
    body.gradient.reinit(2 * n, body.n_poles());
    unsigned int k = 0;
    for (unsigned int order = 0; order <= ring.highest_order; ++order)
      for (const unsigned int end = k + (order == 0 ? body.n_poles() - 4 * ring.highest_order : 4); k < end;
           ++k)
        for (unsigned int i = 0; i < n; ++i)
          body.gradient(n + i, k) =
              (j * double(order) * body.right(n + i, k) - body.right(i, k)) / ring.radius;

    // rows along theta of the points and of those in front of them
    DenseMatrix band;
    if (ring.residual)
    {
      const std::vector<double> angles = ring.angles();
      for (unsigned int step = 1; step < difference.size(); ++step)
      {
        const double beyond = step * ring.spacing / ring.radius;
        rows.push_back({rotation < 0 ? angles.back() + beyond : angles.front() - beyond, true});
      }
      band = ring_residual(ring, rows, rotation, RingFrame::road);
    }
    body.residual_gradient = residual_gradient(ring, band, rotation, difference);
  }

  DenseMatrix residual_gradient(const RingParameters &ring, const DenseMatrix &band, const double rotation,
                                const std::vector<double> &difference)
  {
    const unsigned int n = ring.n_points;
    DenseMatrix result(2 * n, 2 * n);
    // the material comes from larger theta if the ring turns to smaller ones
    const int upstream = rotation < 0 ? 1 : -1;
    const auto is_point = [n](const int place) { return place >= 0 && place < int(n); };
    const double forward = -upstream / ring.spacing, tread = ring.tread_compliance(true);
    for (unsigned int i = 0; i < n && tread > 0; ++i)
      for (unsigned int step = 0; step < difference.size(); ++step)
        if (const int place = int(i) + upstream * int(step); is_point(place))
          result(n + i, n + place) += forward * difference[step] * tread;
    const unsigned int n_front = band.m() > 0 ? band.m() - 2 * n : 0;
    for (unsigned int i = 0; i < n && band.m() > 0; ++i)
    {
      const unsigned int n_before = upstream > 0 ? n - 1 - i : i, n_known = n_before + n_front;
      const std::vector<double> c = n_known + 1 >= difference.size() ? difference
                                    : n_known > 0                    ? std::vector<double>{1., -1.}
                                                                     : std::vector<double>();
      for (unsigned int b = 0; b < 2 * n; ++b)
      {
        double slope = -band(i, b) / ring.radius;
        for (unsigned int step = 0; step < c.size(); ++step)
        {
          const int place = int(i) + upstream * int(step);
          const unsigned int row = is_point(place) ? n + place : 2 * n + step - n_before - 1;
          slope += forward * c[step] * band(row, b);
        }
        result(n + i, b) += slope;
      }
    }
    return result;
  }

  DenseMatrix ring_rest(const RingParameters &ring, const std::vector<RingRow> &rows, const double rotation,
                        const RingFrame frame)
  {
    DenseMatrix rest(rows.size(), rows.size());
    if (ring.residual)
      rest = ring_residual(ring, rows, rotation, frame);
    for (unsigned int i = 0; i < rows.size(); ++i)
      rest(i, i) += ring.tread_compliance(rows[i].tangential);
    return rest;
  }

  ComplexMatrix ring_receptance(const RingParameters &ring, const std::vector<RingRow> &rows,
                                const double rotation, const RingFrame frame, const double omega)
  {
    ComplexMatrix result(rows.size(), rows.size());
    std::vector<Complex> phase(rows.size());
    for (int n = -int(ring.highest_order); n <= int(ring.highest_order); ++n)
    {
      Matrix2 H =
          order_receptance(ring, n, rotation, frame == RingFrame::road ? omega + n * rotation : omega);
      H /= Complex(2 * dealii::numbers::PI * ring.radius);
      for (unsigned int i = 0; i < rows.size(); ++i)
        phase[i] = sign(rows[i]) * std::polar(1., n * rows[i].angle);
      for (unsigned int b = 0; b < rows.size(); ++b)
        for (unsigned int a = 0; a < rows.size(); ++a)
          result(a, b) += H[component(rows[a])][component(rows[b])] * phase[a] * std::conj(phase[b]);
    }
    return result;
  }

  DenseMatrix ring_residual(const RingParameters &ring, const std::vector<RingRow> &rows,
                            const double rotation, const RingFrame frame)
  {
    const unsigned int first = ring.highest_order + 1;
    std::vector<Matrix2> H;
    for (unsigned int n = first; n <= ring.residual_order; ++n)
    {
      check_held(ring, n);
      H.push_back(order_receptance(ring, n, rotation, frame == RingFrame::road ? n * rotation : 0.));
    }
    // evenly spaced points have few distances
    std::map<std::tuple<long long, unsigned int, unsigned int>, double> known;
    DenseMatrix result(rows.size(), rows.size());
    for (unsigned int a = 0; a < rows.size(); ++a)
      for (unsigned int b = 0; b < rows.size(); ++b)
      {
        const double angle = rows[a].angle - rows[b].angle;
        const unsigned int i = component(rows[a]), l = component(rows[b]);
        const auto found = known.insert({{std::llround(1e12 * angle), i, l}, 0.});
        double &sum = found.first->second;
        for (unsigned int k = 0; found.second && k < H.size(); ++k)
          sum += 2 * (H[k][i][l] * std::polar(1., (first + k) * angle)).real();
        result(a, b) = sign(rows[a]) * sign(rows[b]) * sum / (2 * dealii::numbers::PI * ring.radius);
      }
    return result;
  }

  BodyInContact ring_modes(const RingParameters &ring, const std::vector<RingRow> &rows)
  {
    const unsigned int n_rows = rows.size(), n_modes = 2 + 4 * ring.highest_order;
    const double m = ring.line_density() * dealii::numbers::PI * ring.radius;
    BodyInContact body;
    body.trace.reinit(n_rows, n_modes);
    body.damping_ratio.assign(n_modes, ring.damping_ratio);
    body.modal_load.assign(n_modes, 0.);
    body.residual_load.assign(n_rows, 0.);
    body.participation.reinit(n_modes, 3);
    for (unsigned int n = 0; n <= ring.highest_order; ++n)
    {
      check_held(ring, n);
      const RingParameters::Order L = ring.order(n);
      const auto [slow, fast] = ring.frequencies(n);
      const double angle = 0.5 * std::atan2(2 * L.coupling, L.tangential - L.radial), s = std::sin(angle),
                   c = std::cos(angle);
      // v = a cos(n theta), w = -b sin(n theta), and a quarter of a wave farther
      const std::array<std::pair<double, std::array<double, 2>>, 2> branches = {
          {{slow, {{-s, c}}}, {fast, {{c, s}}}}};
      for (unsigned int branch = 0; branch < 2; ++branch)
        for (unsigned int shift = 0; shift < (n == 0 ? 1 : 2); ++shift)
        {
          const auto &[omega, shape] = branches[branch];
          const unsigned int k = body.omega.size();
          for (unsigned int i = 0; i < n_rows; ++i)
          {
            const double turn = n * rows[i].angle;
            const double wave = n == 0                               ? 1 / std::sqrt(2.)
                                : rows[i].tangential == (shift == 0) ? std::cos(turn)
                                : rows[i].tangential                 ? std::sin(turn)
                                                                     : -std::sin(turn);
            body.trace(i, k) = sign(rows[i]) * shape[component(rows[i])] * wave / std::sqrt(m);
          }
          // a ring that moves as a whole: v = cos(theta), w = sin(theta) forward, v = sin(theta), w = -cos(theta) up
          if (n == 1)
            body.participation(k, shift == 0 ? 0 : 2) = std::sqrt(m) * (shape[0] - shape[1]);
          body.omega.push_back(omega);
          body.labels.push_back("n=" + std::to_string(n) + ", branch " + std::to_string(branch + 1));
        }
    }
    body.residual = ring_rest(ring, rows, 0, RingFrame::road);
    return body;
  }

  BodyInContact RingParameters::between_points(const bool with_friction, const double speed,
                                               const std::vector<double> &upstream) const
  {
    const std::vector<RingRow> rows = ring_rows(*this, with_friction);
    const double turning = rotation(speed);
    if (turning == 0)
      return ring_modes(*this, rows);
    BodyInContact body = ring_poles(*this, rows, turning);
    if (!upstream.empty())
      add_gradient(body, *this, turning, upstream);
    return body;
  }

  std::vector<std::string> RingParameters::row_names(const bool with_friction) const
  {
    const auto point = [&](const unsigned int i)
    { return n_points <= 26 ? std::string(1, char('A' + i)) : "P" + std::to_string(i); };
    std::vector<std::string> names;
    for (const char *direction : {"_z", "_x"})
      for (unsigned int i = 0; i < n_points && (with_friction || direction[1] == 'z'); ++i)
        names.push_back(point(i) + direction);
    return names;
  }

  std::function<ComplexMatrix(double)> RingParameters::sum_of_orders(const unsigned int highest,
                                                                     const bool with_residual,
                                                                     const bool with_friction,
                                                                     const double speed) const
  {
    RingParameters ring = *this;
    ring.highest_order = highest;
    ring.residual = with_residual;
    ring.residual_order = std::max(ring.residual_order, highest + 1);
    const std::vector<RingRow> rows = ring_rows(ring, with_friction);
    const double turning = rotation(speed);
    const DenseMatrix rest = ring_rest(ring, rows, turning, RingFrame::road);
    return [=](const double omega)
    {
      ComplexMatrix G = ring_receptance(ring, rows, turning, RingFrame::road, omega);
      for (unsigned int i = 0; i < rows.size(); ++i)
        for (unsigned int j = 0; j < rows.size(); ++j)
          G(i, j) += rest(i, j);
      return G;
    };
  }
} // namespace vibrocontact
