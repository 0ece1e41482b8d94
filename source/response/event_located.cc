#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/unilateral_contact.h>
#include <vibrocontact/response/event_located.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// nodes of the road's interpolation in a piece
    constexpr unsigned int n_nodes = 8;
    constexpr unsigned int most_orders = 60;
    /// gaps and rates below it are rounding, in parts of the largest height and rate so far
    constexpr double gap_rounding = 1e-13, rate_rounding = 1e-12;
    using Nodes = std::array<double, n_nodes>;

    /// Chebyshev points of [0, 1] and the matrix from values there to coefficients of powers.
    struct Interpolation
    {
      Interpolation()
      {
        for (unsigned int i = 0; i < n_nodes; ++i)
          x[i] = 0.5 - 0.5 * std::cos(std::acos(-1.) * (i + 0.5) / n_nodes);
        for (unsigned int i = 0; i < n_nodes; ++i)
        {
          // Lagrange polynomial of point i
          Nodes own{};
          own[0] = 1;
          unsigned int degree = 0;
          for (unsigned int j = 0; j < n_nodes; ++j)
            if (j != i)
            {
              const double factor = 1 / (x[i] - x[j]);
              ++degree;
              for (unsigned int k = degree + 1; k-- > 0;)
                own[k] = ((k > 0 ? own[k - 1] : 0.) - x[j] * own[k]) * factor;
            }
          for (unsigned int k = 0; k < n_nodes; ++k)
            to_powers[k][i] = own[k];
        }
      }

      void powers(const Nodes &values, std::vector<double> &c) const
      {
        for (unsigned int k = 0; k < n_nodes; ++k)
        {
          c[k] = 0;
          for (unsigned int i = 0; i < n_nodes; ++i)
            c[k] += to_powers[k][i] * values[i];
        }
      }

      Nodes x;
      std::array<Nodes, n_nodes> to_powers;
    };

    const Interpolation interpolation;

    double derivative(const std::vector<double> &c, const double x)
    {
      double result = 0;
      for (std::size_t k = c.size(); k-- > 1;)
        result = result * x + k * c[k];
      return result;
    }

    /// where f passes through zero between a and b, of different signs there
    template <typename Function>
    double root(const Function &f, double a, double b)
    {
      double fa = f(a), fb = f(b), before = a;
      // Illinois: false position that does not get stuck on one side
      for (unsigned int k = 0; k < 200 && b - a > 1e-16; ++k)
      {
        double x = k % 8 == 7 || fa == fb ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
        if (!(x > a && x < b))
          x = 0.5 * (a + b);
        if (!(x > a && x < b))
          break;
        const double fx = f(x);
        if (fx == 0 || std::abs(x - before) < 2e-15)
          return x;
        before = x;
        if ((fx < 0) == (fb < 0))
        {
          b = x;
          fb = fx;
          fa *= 0.5;
        }
        else
        {
          a = x;
          fa = fx;
          fb *= 0.5;
        }
      }
      return 0.5 * (a + b);
    }

    /// Where a function of x, from 0 to 1, first falls below zero by more than rounding; 2: nowhere.
    /// @param starts_at_zero its zero at x = 0 is none
    template <typename Value, typename Slope>
    double first_fall(const Value &f, const Slope &slope, const double rounding, const bool starts_at_zero)
    {
      constexpr unsigned int n_samples = 8;
      const auto place = [](const unsigned int k) { return double(k) / n_samples; };
      // where it passes zero between a sample and a place below zero
      const auto fall = [&](double x, double value, const double low)
      {
        // what begins with zero may rise and fall within the first interval
        for (unsigned int j = 1; j <= 40 && value <= 0; ++j)
        {
          const double nearer = x + (low - x) * std::ldexp(1., -static_cast<int>(j));
          if (f(nearer) <= 0)
            continue;
          value = f(nearer);
          x = nearer;
        }
        return value > 0 ? root(f, x, low) : x;
      };
      double values[n_samples + 1];
      values[0] = starts_at_zero ? 0. : f(0.);
      for (unsigned int k = 1; k <= n_samples; ++k)
      {
        values[k] = f(place(k));
        if (values[k] < -rounding)
          return fall(place(k - 1), values[k - 1], place(k));
        // a smallest value between samples
        unsigned int left = n_samples;
        if (k >= 2 && values[k - 1] <= values[k - 2] && values[k - 1] < values[k])
          left = k - 2;
        else if (k == 1 && values[1] > values[0])
          left = 0;
        else if (k == n_samples && values[k] < values[k - 1])
          left = k - 1;
        if (left == n_samples || slope(place(left)) >= 0 || slope(place(k)) <= 0)
          continue;
        const double low = root(slope, place(left), place(k));
        if (f(low) < -rounding)
          return fall(place(left), values[left], low);
      }
      return 2;
    }

    DenseMatrix block_of(const DenseMatrix &full, const std::vector<unsigned int> &points)
    {
      DenseMatrix block(points.size(), points.size());
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int j = 0; j < points.size(); ++j)
          block(i, j) = full(points[i], points[j]);
      return block;
    }

    /// 0 <= q perp gap + M q >= 0 over some points; gap holds the result
    void solve_contact(const DenseMatrix &matrix, const std::vector<unsigned int> &points,
                       std::vector<double> &gap, std::vector<double> &q)
    {
      if (points.size() > 1)
        return UnilateralContact(block_of(matrix, points), "at an impact").solve(gap.data(), q.data());
      q[0] = std::max(0., -gap[0] / matrix(points[0], points[0]));
      gap[0] = std::max(0., gap[0]);
    }
  } // namespace

  void exchange(CheckpointFile &file, const std::string &name, std::vector<ContactEvent> &events)
  {
    std::vector<double> numbers;
    for (const ContactEvent &event : events)
      numbers.insert(numbers.end(), {event.time, double(event.point), event.impulse});
    file(name, numbers);
    events.clear();
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
      events.push_back({numbers[k], static_cast<unsigned int>(numbers[k + 1]), numbers[k + 2]});
  }

  double EventLocated::Piece::horner(const std::vector<double> &c, const double x)
  {
    double result = 0;
    for (std::size_t k = c.size(); k-- > 0;)
      result = result * x + c[k];
    return result;
  }

  EventLocated::EventLocated(const PoleModel &model, const std::vector<Complex> &state, const Road &road,
                             const double longest_piece)
      : impulse(model.n_rows(), 0.), model(model), road(road), n(model.n_rows()), n_poles(model.n_poles()),
        piece(longest_piece), first(initial_derivative(model, 1)), second(initial_derivative(model, 2)),
        z(state), is_closed(n, 0), just_open(n, 0)
  {
    if (model.residual.m() > 0 && model.residual.linfty_norm() > 0)
      throw InputError(
          "The event-located method needs rigid contact points, but the body has a residual or tread "
          "flexibility at its contact points: leave it out or take the modal recursion.");
    double fastest = 0, size = 0;
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      fastest = std::max(fastest, std::abs(model.poles[k]));
      for (unsigned int i = 0; i < n; ++i)
        size = std::max(size, std::abs(model.right(i, k) * model.left(i, k)));
    }
    if (initial_derivative(model, 0).linfty_norm() > 1e-9 * size * n_poles)
      throw InputError(
          "The event-located method needs Green's functions that begin with zero, but g(0) is not: "
          "identify the body with g(0) = 0 or take the modal recursion.");
    if (!(definiteness(first) > 0))
      throw InputError(
          "The event-located method needs g'(0) (the inverse of the mass that the contact points feel) "
          "positive definite, which it is not: leave out contact points, keep more modes or identify "
          "the body with that condition.");
    smooth_length = piece = std::min(piece, 2 / fastest);
    series.assign(most_orders, std::vector<Complex>(n_poles));
    u.assign(n, std::vector<double>(most_orders, 0.));
    q = u;

    std::vector<unsigned int> touching;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double height = road.height(i, 0), distance = displacement(i, 0) - height;
      height_scale = std::max(height_scale, std::abs(height));
      const double rounding = smallest_gap();
      if (distance < -rounding)
      {
        std::ostringstream text;
        text << "Contact point " << i << " begins " << -distance
             << " m below the road: lower Road/Indentation or give a Loading time.";
        throw InputError(text.str());
      }
      if (distance <= rounding)
        touching.push_back(i);
    }
    if (!touching.empty())
      touch(touching);
  }

  double EventLocated::smallest_gap() const
  {
    // the road moves on while the time does not
    return gap_rounding * height_scale + 8 * std::numeric_limits<double>::epsilon() * now * rate_scale;
  }

  double EventLocated::displacement(const unsigned int i, const unsigned int order) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      Complex value = z[k];
      for (unsigned int j = 0; j < order; ++j)
        value = model.poles[k] * value + (j == 0 && !model.load.empty() ? model.load[k] : 0.);
      sum += 2 * (model.right(i, k) * value).real();
    }
    return sum;
  }

  void EventLocated::touch(const std::vector<unsigned int> &touching)
  {
    std::vector<unsigned int> points = closed;
    points.insert(points.end(), touching.begin(), touching.end());
    std::sort(points.begin(), points.end());
    const unsigned int m = points.size();
    std::vector<double> approach(m), jump(m);
    for (unsigned int i = 0; i < m; ++i)
    {
      const double rate = displacement(points[i], 1), road_rate = road.at(points[i], now).first;
      approach[i] = rate - road_rate;
      rate_scale = std::max({rate_scale, std::abs(rate), std::abs(road_rate)});
    }
    // points that rock bounce ever more often in a finite time; once their flights are too short to be seen, they rest
    const double rounding = std::pow(10., std::min(stuck, 8u)) * rate_rounding * rate_scale;
    solve_contact(first, points, approach, jump);
    std::vector<unsigned int> candidates;
    for (unsigned int i = 0; i < m; ++i)
    {
      const unsigned int point = points[i];
      if (jump[i] > 0)
      {
        // what is left of a point's rate after its last impact is none
        if (jump[i] * first(point, point) > rounding)
          impacts.push_back({now, point, jump[i]});
        impulse[point] += jump[i];
        for (unsigned int k = 0; k < n_poles; ++k)
          z[k] += model.left(point, k) * jump[i];
      }
      if (jump[i] > 0 || approach[i] <= rounding)
        candidates.push_back(point);
      else
      {
        if (is_closed[point])
          releases.push_back({now, point});
        is_closed[point] = 0;
        just_open[point] = 1;
      }
    }
    closed.clear();
    find_closed_forces(candidates);
  }

  void EventLocated::find_closed_forces(const std::vector<unsigned int> &candidates)
  {
    const unsigned int m = candidates.size();
    if (m > 0)
    {
      std::vector<double> acceleration(m), force(m);
      for (unsigned int i = 0; i < m; ++i)
        acceleration[i] = displacement(candidates[i], 2) - road.at(candidates[i], now).second;
      solve_contact(first, candidates, acceleration, force);
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int point = candidates[i];
        is_closed[point] = force[i] > 0;
        just_open[point] = force[i] <= 0;
        if (force[i] > 0)
          closed.push_back(point);
        else
          releases.push_back({now, point});
      }
    }
    invert_closed();
    project();
  }

  void EventLocated::invert_closed()
  {
    const unsigned int m = closed.size();
    closed_inverse.assign(m * m, 0.);
    if (m == 0)
      return;
    DenseMatrix inverse = block_of(first, closed);
    inverse.invert();
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        closed_inverse[i * m + j] = inverse(i, j);
  }

  void EventLocated::project()
  {
    const unsigned int m = closed.size();
    std::vector<double> alpha(m, 0.), beta(m, 0.);
    for (unsigned int pass = 0; pass < 2 && m > 0; ++pass)
    {
      std::fill(alpha.begin(), alpha.end(), 0.);
      std::fill(beta.begin(), beta.end(), 0.);
      for (unsigned int j = 0; j < m; ++j)
      {
        const double left_over = displacement(closed[j], 0) - road.height(closed[j], now);
        for (unsigned int i = 0; i < m; ++i)
          beta[i] += closed_inverse[i * m + j] * left_over;
      }
      for (unsigned int j = 0; j < m; ++j)
      {
        double left_over = displacement(closed[j], 1) - road.at(closed[j], now).first;
        for (unsigned int i = 0; i < m; ++i)
          left_over -= second(closed[j], closed[i]) * beta[i];
        for (unsigned int i = 0; i < m; ++i)
          alpha[i] += closed_inverse[i * m + j] * left_over;
      }
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int k = 0; k < n_poles; ++k)
          z[k] -= model.left(closed[i], k) * (alpha[i] + beta[i] * model.poles[k]);
    }
  }

  bool EventLocated::expand(const double length)
  {
    const unsigned int m = closed.size();
    // the road's acceleration as a polynomial of x = (t - now) / length
    std::vector<std::vector<double>> acceleration(m, std::vector<double>(n_nodes));
    for (unsigned int j = 0; j < m; ++j)
    {
      Nodes values;
      double largest = 0;
      for (unsigned int k = 0; k < n_nodes; ++k)
      {
        values[k] = road.at(closed[j], now + length * interpolation.x[k]).second;
        largest = std::max(largest, std::abs(values[k]));
      }
      interpolation.powers(values, acceleration[j]);
      // the last Chebyshev coefficient; 2^(2 k - 1) is the first power's in that polynomial on [0, 1]
      if (std::abs(acceleration[j].back()) > std::ldexp(1e-9, 2 * n_nodes - 3) * largest &&
          length > 1e-3 * piece)
        return false;
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      u[i].assign(most_orders, 0.);
      q[i].assign(most_orders, 0.);
    }
    series[0] = z;
    std::vector<double> unbalanced(m);
    double largest = 0;
    unsigned int small = 0;
    for (unsigned int order = 0; order < most_orders; ++order)
    {
      const std::vector<Complex> &c = series[order];
      double size = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        double sum = 0;
        for (unsigned int k = 0; k < n_poles; ++k)
          sum += model.right(i, k).real() * c[k].real() - model.right(i, k).imag() * c[k].imag();
        u[i][order] = 2 * sum;
      }
      for (unsigned int k = 0; k < n_poles; ++k)
        size = std::max(size, std::abs(c[k].real()) + std::abs(c[k].imag()));
      largest = std::max(largest, size);
      small = size <= 1e-18 * largest ? small + 1 : 0;
      n_orders = order + 1;
      if ((small > 1 && order >= n_nodes) || n_orders == most_orders)
        break;
      for (unsigned int j = 0; j < m; ++j)
      {
        double sum = 0;
        for (unsigned int k = 0; k < n_poles; ++k)
        {
          Complex value = model.poles[k] * c[k];
          if (order == 0 && !model.load.empty())
            value += model.load[k];
          sum += 2 * (model.right(closed[j], k) * model.poles[k] * value).real();
        }
        unbalanced[j] = (order < n_nodes ? acceleration[j][order] : 0.) - sum;
      }
      for (unsigned int i = 0; i < m; ++i)
      {
        double force = 0;
        for (unsigned int j = 0; j < m; ++j)
          force += closed_inverse[i * m + j] * unbalanced[j];
        q[closed[i]][order] = force;
      }
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        Complex rate = model.poles[k] * c[k];
        if (order == 0 && !model.load.empty())
          rate += model.load[k];
        for (const unsigned int i : closed)
          rate += model.left(i, k) * q[i][order];
        series[order + 1][k] = rate * (length / (order + 1));
      }
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      u[i].resize(n_orders);
      q[i].resize(n_orders);
    }
    return true;
  }

  double EventLocated::first_touch(const unsigned int i, const double length) const
  {
    // what has just opened begins with a gap of zero but for rounding
    const double offset = just_open[i] ? u[i][0] - road.height(i, now) : 0.;
    return first_fall(
        [&](const double x) { return Piece::horner(u[i], x) - road.height(i, now + x * length) - offset; },
        [&](const double x) { return derivative(u[i], x) - length * road.at(i, now + x * length).first; },
        smallest_gap(), just_open[i]);
  }

  double EventLocated::first_release(const unsigned int i) const
  {
    double largest = 0;
    for (const double coefficient : q[i])
      largest += std::abs(coefficient);
    return first_fall([&](const double x) { return Piece::horner(q[i], x); },
                      [&](const double x) { return derivative(q[i], x); }, 1e-13 * largest, q[i][0] <= 0);
  }

  void EventLocated::advance(const double end, const Observer &observe)
  {
    while (now < end)
    {
      const double target = std::min(end, road.next_jump(now));
      double length = std::min(piece, target - now);
      if (!closed.empty())
        length = std::min(length, 2 * smooth_length);
      while (!expand(length))
        length *= 0.5;
      if (!closed.empty())
        smooth_length = length;
      double x = 2;
      unsigned int point = 0;
      for (unsigned int i = 0; i < n; ++i)
        height_scale = std::max(height_scale, std::abs(u[i][0]));
      for (unsigned int i = 0; i < n; ++i)
      {
        const double own = is_closed[i] ? first_release(i) : first_touch(i, length);
        if (own < x)
        {
          x = own;
          point = i;
        }
      }
      const bool event = x <= 1;
      x = std::min(x, 1.);
      if (!std::isfinite(u[0][0]))
        throw ConvergenceError("The event-located motion is no longer finite.");
      const double begin = now;
      if (x > 0)
      {
        observe({begin, begin + x * length, length, u, q});
        for (const unsigned int i : closed)
        {
          double integral = 0;
          for (unsigned int k = n_orders; k-- > 0;)
            integral = integral * x + q[i][k] / (k + 1);
          impulse[i] += integral * x * length;
        }
        for (unsigned int k = 0; k < n_poles; ++k)
        {
          Complex value = 0;
          for (unsigned int order = n_orders; order-- > 0;)
            value = value * x + series[order][k];
          z[k] = value;
        }
        now = event ? begin + x * length : begin + length;
        if (!event && length == target - begin)
          now = target;
        ++pieces;
      }
      stuck = x * length > 1e-6 * piece ? 0 : stuck + 1;
      if (stuck > 1000)
      {
        std::ostringstream text;
        text << "More than 1,000 impacts and releases follow each other at t = " << now
             << " s: the points are too many for the event-located method, take the modal recursion.";
        throw ConvergenceError(text.str());
      }
      for (unsigned int i = 0; i < n; ++i)
        if (x > 1e-9)
          just_open[i] = 0;
      if (!event)
      {
        project();
        continue;
      }
      if (is_closed[point])
      {
        releases.push_back({now, point});
        is_closed[point] = 0;
        just_open[point] = 1;
        closed.erase(std::find(closed.begin(), closed.end(), point));
        invert_closed();
        project();
        continue;
      }
      // points that touch at the same time, by symmetry for instance
      std::vector<unsigned int> touching;
      for (unsigned int i = 0; i < n; ++i)
        if (i == point ||
            (!is_closed[i] && !just_open[i] && displacement(i, 0) - road.height(i, now) <= smallest_gap()))
          touching.push_back(i);
      touch(touching);
    }
  }

  void EventLocated::exchange(CheckpointFile &file)
  {
    std::vector<double> real, imaginary;
    for (const Complex &value : z)
    {
      real.push_back(value.real());
      imaginary.push_back(value.imag());
    }
    file("events/real", real);
    file("events/imaginary", imaginary);
    for (unsigned int k = 0; k < n_poles; ++k)
      z[k] = {real.at(k), imaginary.at(k)};
    file("events/time", now);
    file("events/height_scale", height_scale);
    file("events/rate_scale", rate_scale);
    file("events/smooth_length", smooth_length);
    file("events/closed", closed);
    file("events/is_closed", is_closed);
    file("events/just_open", just_open);
    file("events/impulse", impulse);
    file("events/pieces", pieces);
    vibrocontact::exchange(file, "events/impacts", impacts);
    vibrocontact::exchange(file, "events/releases", releases);
    invert_closed();
  }
} // namespace vibrocontact
