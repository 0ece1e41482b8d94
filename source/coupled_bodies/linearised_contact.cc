#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/linearised_contact.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    DenseMatrix rows(const DenseMatrix &matrix, const std::vector<unsigned int> &points)
    {
      DenseMatrix result(points.size(), matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int k = 0; k < points.size(); ++k)
          result(k, j) = matrix(points[k], j);
      return result;
    }

    // inverse(a) b
    DenseMatrix solve(DenseMatrix a, DenseMatrix b, const std::string &what)
    {
      if (a.m() == 0 || b.n() == 0)
        return b;
      try
      {
        a.compute_lu_factorization();
        a.solve(b);
      }
      catch (const dealii::ExceptionBase &)
      {
        throw ConvergenceError(
            "The linearised contact has a singular " + what +
            ": the residual flexibility does not hold the contact points; keep fewer modes.");
      }
      return b;
    }

    // inverse(G) b; with a given force the approach moves the gaps by `hub`, along which the columns then sum to zero
    DenseMatrix close_gaps(const DenseMatrix &G, const DenseMatrix &b, const bool force_given,
                           const std::vector<double> &hub)
    {
      if (G.m() == 0 || b.n() == 0)
        return b;
      DenseMatrix right(b.m(), b.n() + 1);
      add_block(right, b, 0, 0);
      for (unsigned int i = 0; i < b.m(); ++i)
        right(i, b.n()) = hub[i];
      const DenseMatrix x = solve(G, right, "normal flexibility");
      const auto sum = [&](const unsigned int column)
      {
        double result = 0;
        for (unsigned int i = 0; i < x.m(); ++i)
          result += hub[i] * x(i, column);
        return result;
      };
      const double approach = sum(b.n());
      DenseMatrix result(b.m(), b.n());
      for (unsigned int j = 0; j < b.n(); ++j)
      {
        const double share = force_given ? sum(j) / approach : 0;
        for (unsigned int i = 0; i < b.m(); ++i)
          result(i, j) = x(i, j) - share * x(i, b.n());
      }
      return result;
    }
    /// What moves without the contact: x' = transition x + (0, input R), x = (q, v, Re z, Im z), of which forces do not
    /// move the first n_modes, q, at once,
    ///
    ///   du = displacement x + W R,     du' = rate x + rate_at_once R + W R'
    struct FreeMotion
    {
      DenseMatrix transition, input, displacement, rate, rate_at_once;
    };

    FreeMotion free_motion(const ContactPair &pair)
    {
      const unsigned int n_rows = 3 * pair.n_points(), m = pair.n_modes(), p = pair.n_poles(),
                         size = 2 * (m + p);
      FreeMotion motion;
      motion.transition.reinit(size, size);
      motion.input.reinit(size - m, n_rows);
      motion.displacement.reinit(n_rows, size);
      motion.rate.reinit(n_rows, size);
      for (unsigned int k = 0; k < m; ++k)
      {
        motion.transition(k, m + k) = 1;
        motion.transition(m + k, k) = -pair.omega[k] * pair.omega[k];
        motion.transition(m + k, m + k) = -2 * pair.damping_ratio[k] * pair.omega[k];
        for (unsigned int i = 0; i < n_rows; ++i)
          motion.displacement(i, k) = motion.rate(i, m + k) = motion.input(k, i) = pair.trace(i, k);
      }
      for (unsigned int d = 0; pair.hub && d < 3; ++d)
        for (unsigned int j = 0; j < pair.hub->shapes.n(); ++j)
          for (unsigned int k = 0; k < pair.hub->shapes.n(); ++k)
            motion.transition(m + k, m + j) -=
                pair.hub->damping[d] * pair.hub->motion(d, k) * pair.hub->motion(d, j);
      for (unsigned int k = 0; k < p; ++k)
      {
        const unsigned int re = 2 * m + k, im = re + p;
        const std::complex<double> &pole = pair.poles[k];
        motion.transition(re, re) = motion.transition(im, im) = pole.real();
        motion.transition(im, re) = pole.imag();
        motion.transition(re, im) = -pole.imag();
        for (unsigned int i = 0; i < n_rows; ++i)
        {
          const std::complex<double> right = 2. * pair.right(i, k), moving = right * pole;
          motion.displacement(i, re) = right.real();
          motion.displacement(i, im) = -right.imag();
          motion.rate(i, re) = moving.real();
          motion.rate(i, im) = -moving.imag();
          motion.input(re - m, i) = pair.left(i, k).real();
          motion.input(im - m, i) = pair.left(i, k).imag();
        }
      }
      if (p > 0)
        motion.rate_at_once = sum_over_poles(pair, std::vector<std::complex<double>>(p, 1.));
      return motion;
    }

    /// What V d/dx of poles and W~ is beyond the differences between points.
    void add_gradients(const ContactPair &pair, const double speed, DenseMatrix &by_x, DenseMatrix &by_R)
    {
      const ComplexMatrix &gradient = pair.gradient;
      for (unsigned int k = 0; k < gradient.n(); ++k)
        for (unsigned int i = 0; i < gradient.m(); ++i)
        {
          by_x(i, 2 * pair.n_modes() + k) += 2 * speed * gradient(i, k).real();
          by_x(i, 2 * pair.n_modes() + pair.n_poles() + k) -= 2 * speed * gradient(i, k).imag();
        }
      if (gradient.m() > 0)
        by_R.add(speed, pair.residual_gradient);
    }

    /// As of a mode of unit mass: free of how right and left shape share their size.
    double size_of_pole(const BodyInContact &body, const unsigned int k)
    {
      double right = 0, left = 0;
      for (unsigned int i = 0; i < body.right.m(); ++i)
      {
        right = std::max(right, std::abs(body.right(i, k)));
        left = std::max(left, std::abs(body.left(i, k)));
      }
      return left > 0 ? std::sqrt(right / (left * 2 * std::abs(body.poles[k]))) : 0;
    }
  } // namespace

  DenseMatrix compliance_of_contact(const ContactPair &pair, const RollingEquilibrium &equilibrium)
  {
    DenseMatrix W = pair.residual;
    for (unsigned int i = 0; i < equilibrium.normal_compliance.size(); ++i)
      W(i, i) += equilibrium.normal_compliance[i];
    return W;
  }

  std::vector<double> gaps_by_approach(const ContactPair &pair, const std::vector<unsigned int> &points)
  {
    const DenseMatrix hub = pair.interface.contacts.translation_of(0);
    std::vector<double> result;
    for (const unsigned int point : points)
      result.push_back(hub(point, 2));
    return result;
  }

  DenseMatrix linearised_contact(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const LinearisationOptions &options)
  {
    const unsigned int n = pair.n_points();
    const DenseMatrix W = compliance_of_contact(pair, equilibrium);

    SlidingFrame frame = sliding_frame(equilibrium);
    const std::vector<unsigned int> &points = frame.points;
    const unsigned int c = points.size(), n_stick = frame.n_stick;
    if (n_stick > 0 && !options.stick)
      throw InputError(
          "The equilibrium is not in full sliding (" + std::to_string(n_stick) + " of " + std::to_string(c) +
          " points stick): raise the creepage, or set Stability/Linearise sticking points to true.");
    if (n_stick > 0 && !options.residual_rate)
      throw InputError("Points stick at the equilibrium, which only the consistent linearisation takes: set "
                       "Stability/Linearisation to consistent.");
    if (!options.lateral_damping)
      frame.keep_sticking_only();
    const std::vector<ContactDirection> &across = frame.across;
    const unsigned int n_z = across.size();

    // slip by x and R: V d/dx of the displacements, and rates; that of W R comes with R'
    const FreeMotion motion = free_motion(pair);
    const unsigned int n_x = motion.transition.m(), m = pair.n_modes();
    DenseMatrix slip_by_x(3 * n, n_x), slip_by_R(3 * n, 3 * n);
    if (options.convection)
    {
      slip_by_x = motion.displacement;
      slip_by_R = W;
      convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, slip_by_x);
      convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, slip_by_R);
      add_gradients(pair, equilibrium.speed, slip_by_x, slip_by_R);
    }
    slip_by_x.add(1., motion.rate);
    if (pair.n_poles() > 0)
      slip_by_R.add(1., motion.rate_at_once);

    // R = E_N N + E_z s + E_x x; the last from friction that falls with the speed, itself among R
    DenseMatrix E_N = frame.normal, E_z = forces_along(across, n), E_x(3 * n, n_x);
    if (!frame.along.empty())
    {
      DenseMatrix fall = forces_along(frame.along, n);
      for (unsigned int k = 0; k < frame.along.size(); ++k)
        for (unsigned int i = 0; i < 3 * n; ++i)
          fall(i, k) *= -frame.falling[k];
      E_x = product(fall, rows_along(slip_by_x, frame.along, n));
      if ((equilibrium.speed > 0 && options.convection) || pair.n_poles() > 0)
      {
        DenseMatrix own = product(fall, rows_along(slip_by_R, frame.along, n));
        own *= -1;
        for (unsigned int i = 0; i < 3 * n; ++i)
          own(i, i) += 1;
        for (DenseMatrix *const E : {&E_N, &E_z, &E_x})
          *E = solve(own, *E, "friction that falls with the slip speed");
      }
    }

    // R = X_x x + X_z s from the closed gaps
    const DenseMatrix W_n = rows(W, points), G = product(W_n, E_N);
    const std::vector<double> hub = gaps_by_approach(pair, points);
    const auto closed = [&](const DenseMatrix &E, const DenseMatrix *const gap)
    {
      if (E.n() == 0)
        return E;
      DenseMatrix opened = product(W_n, E);
      if (gap)
        opened.add(1., *gap);
      DenseMatrix X = product(E_N, close_gaps(G, opened, equilibrium.force_given, hub));
      X *= -1;
      X.add(1., E);
      return X;
    };
    const DenseMatrix gap_by_x = rows(motion.displacement, points);
    const DenseMatrix X_x = closed(E_x, &gap_by_x), X_z = closed(E_z, nullptr);

    // slip across t: ds = S_x x + S_r R + W_d R'
    const DenseMatrix S_x = rows_along(slip_by_x, across, n), S_r = rows_along(slip_by_R, across, n);
    DenseMatrix W_d(n_z, 3 * n);
    if (options.residual_rate)
      W_d = rows_along(W, across, n);

    // x' = (transition + input X_x) x + input X_z s
    const bool has_states =
        n_z > 0 && (options.lateral_damping || n_stick > 0) && (options.residual_rate || n_stick > 0);
    DenseMatrix A(n_x + (has_states ? n_z : 0));
    add_block(A, motion.transition, 0, 0);
    add_block(A, product(motion.input, X_x), m, 0);
    if (n_z == 0)
      return A;

    DenseMatrix slip_x = product(S_r, X_x), slip_z = product(S_r, X_z);
    slip_x.add(1., S_x);
    for (unsigned int k = 0; k < n_z; ++k)
      slip_z(k, k) += frame.mobility[k];
    if (has_states)
    {
      // W_d X_z s' = -slip_x x - (slip_z + mobility) s - W_d X_x x'
      add_block(A, product(motion.input, X_z), m, n_x);
      const DenseMatrix by_rates = product(W_d, X_x);
      DenseMatrix right(n_z, n_x + n_z);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int k = 0; k < n_z; ++k)
          right(k, m + j) = -by_rates(k, j); // q' = v
      if (!frame.along.empty() || pair.n_poles() > 0)
      {
        DenseMatrix others(n_z, n_x - m), rates(n_x - m, n_x + n_z);
        for (unsigned int j = 0; j < n_x - m; ++j)
          for (unsigned int k = 0; k < n_z; ++k)
            others(k, j) = by_rates(k, m + j);
        for (unsigned int j = 0; j < n_x + n_z; ++j)
          for (unsigned int i = 0; i < n_x - m; ++i)
            rates(i, j) = A(m + i, j);
        add_block(right, product(others, rates), 0, 0, -1);
      }
      add_block(right, slip_x, 0, 0, -1);
      add_block(right, slip_z, 0, n_x, -1);
      add_block(A, solve(product(W_d, X_z), right, "tangential flexibility"), n_x, 0);
    }
    else
    {
      // (slip_z + mobility) s = -slip_x x is no state; the paper's C_b, whose effect on N is left out
      slip_x *= -1;
      const DenseMatrix z = solve(slip_z, slip_x, "sliding mobility");
      add_block(A, product(product(motion.input, options.convection ? X_z : E_z), z), m, 0);
    }
    return A;
  }

  Eigenvalues eigenvalues(DenseMatrix matrix, const bool with_left_vectors)
  {
    const dealii::types::blas_int size = matrix.m();
    Eigenvalues result;
    result.vectors.reinit(size);
    result.left.reinit(with_left_vectors ? size : 1);
    std::vector<double> real(size), imaginary(size), work(1);
    dealii::types::blas_int info = 0, n_work = -1;
    const dealii::types::blas_int n_left = result.left.m();
    for (unsigned int pass = 0; pass < 2; ++pass)
    {
      dealii::geev(with_left_vectors ? "V" : "N", "V", &size, &matrix(0, 0), &size, real.data(),
                   imaginary.data(), &result.left(0, 0), &n_left, &result.vectors(0, 0), &size, work.data(),
                   &n_work, &info);
      if (pass == 0)
      {
        n_work = static_cast<dealii::types::blas_int>(work[0]);
        work.resize(n_work);
      }
    }
    if (info != 0)
      throw ConvergenceError(
          "LAPACK found no eigenvalues of the linearised contact (dgeev: " + std::to_string(info) + ").");
    for (int k = 0; k < size; ++k)
      result.values.emplace_back(real[k], imaginary[k]);
    return result;
  }

  bool is_listed(const std::complex<double> &lambda)
  {
    return lambda.imag() > 0 || (lambda.imag() == 0 && lambda.real() > 0);
  }

  StabilityRoot named_root(const std::complex<double> &lambda, std::vector<std::complex<double>> amplitudes,
                           const std::vector<double> &omega, const std::vector<std::string> &labels)
  {
    StabilityRoot root;
    root.frequency = lambda.imag() / (2 * dealii::numbers::PI);
    root.growth = lambda.real();
    root.divergence_rate = lambda.imag() > 0 ? lambda.real() / lambda.imag() : 0;
    double sum = 0, largest = 0;
    for (unsigned int i = 0; i < amplitudes.size(); ++i)
    {
      const double energy = std::norm(amplitudes[i]) * (omega[i] * omega[i] + std::norm(lambda));
      sum += energy;
      if (energy > largest)
      {
        largest = energy;
        root.label = labels[i];
      }
    }
    root.share = sum > 0 ? largest / sum : 0;
    root.shape = std::move(amplitudes);
    return root;
  }

  void sort_roots(std::vector<StabilityRoot> &roots)
  {
    const auto still = std::stable_partition(roots.begin(), roots.end(),
                                             [](const StabilityRoot &root) { return root.frequency > 0; });
    std::stable_sort(roots.begin(), still,
                     [](const StabilityRoot &a, const StabilityRoot &b)
                     { return a.frequency < b.frequency; });
    // roots that differ by growth alone, as undamped ones that couple do: round-off does not choose
    for (auto first = roots.begin(); first != still;)
    {
      const double above = first->frequency * (1 + 1e-7);
      const auto last =
          std::find_if(first, still, [&](const StabilityRoot &root) { return root.frequency >= above; });
      std::stable_sort(first, last,
                       [](const StabilityRoot &a, const StabilityRoot &b) { return a.growth > b.growth; });
      first = last;
    }
  }

  std::vector<StabilityRoot> stability_roots(const ContactPair &pair, DenseMatrix linearised)
  {
    const Eigenvalues lambda = eigenvalues(std::move(linearised));
    const std::vector<double> omega = pair.frequencies();
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < lambda.values.size(); ++k)
    {
      if (!is_listed(lambda.values[k]))
        continue;
      std::vector<std::complex<double>> amplitudes;
      for (unsigned int i = 0; i < pair.n_modes(); ++i)
        amplitudes.push_back(lambda.component(i, k));
      for (unsigned int i = 0; i < pair.n_poles(); ++i)
      {
        const unsigned int re = 2 * pair.n_modes() + i;
        const std::complex<double> a = lambda.component(re, k), b = lambda.component(re + pair.n_poles(), k);
        amplitudes.push_back(
            std::polar(size_of_pole(pair, i) * std::sqrt(2 * (std::norm(a) + std::norm(b))), std::arg(a)));
      }
      roots.push_back(named_root(lambda.values[k], std::move(amplitudes), omega, pair.labels));
    }
    sort_roots(roots);
    return roots;
  }
} // namespace vibrocontact
