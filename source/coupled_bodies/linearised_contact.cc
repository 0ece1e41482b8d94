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
  } // namespace

  DenseMatrix compliance_of_contact(const ContactPair &pair, const RollingEquilibrium &equilibrium)
  {
    DenseMatrix W = pair.residual_flexibility;
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
    const unsigned int n = pair.n_points(), m = pair.n_modes();
    const DenseMatrix W = compliance_of_contact(pair, equilibrium), &Psi = pair.modal_trace;

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

    // gap and slip by R and q: W, Psi, V d/dx of their tangential rows
    DenseMatrix slip_by_q(3 * n, m), slip_by_R(3 * n, 3 * n);
    if (options.convection)
    {
      slip_by_q = Psi;
      slip_by_R = W;
      convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, slip_by_q);
      convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, slip_by_R);
    }

    // R = E_N N + E_z z + E_q q + E_v v; the last two from friction that falls with the speed, itself among R
    DenseMatrix E_N = frame.normal, E_z = forces_along(across, n), E_q(3 * n, m), E_v(3 * n, m);
    if (!frame.along.empty())
    {
      DenseMatrix fall = forces_along(frame.along, n);
      for (unsigned int k = 0; k < frame.along.size(); ++k)
        for (unsigned int i = 0; i < 3 * n; ++i)
          fall(i, k) *= -frame.falling[k];
      E_q = product(fall, rows_along(slip_by_q, frame.along, n));
      E_v = product(fall, rows_along(Psi, frame.along, n));
      if (equilibrium.speed > 0 && options.convection)
      {
        DenseMatrix own = product(fall, rows_along(slip_by_R, frame.along, n));
        own *= -1;
        for (unsigned int i = 0; i < 3 * n; ++i)
          own(i, i) += 1;
        for (DenseMatrix *const E : {&E_N, &E_z, &E_q, &E_v})
          *E = solve(own, *E, "friction that falls with the slip speed");
      }
    }

    // R = X_q q + X_v v + X_z z from the closed gaps
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
    const DenseMatrix Psi_n = rows(Psi, points);
    const DenseMatrix X_q = closed(E_q, &Psi_n), X_v = closed(E_v, nullptr), X_z = closed(E_z, nullptr);

    // slip across t: ds = S_q q + S_r R + Psi_d v + W_d R'
    const DenseMatrix Psi_d = rows_along(Psi, across, n), S_q = rows_along(slip_by_q, across, n),
                      S_r = rows_along(slip_by_R, across, n);
    DenseMatrix W_d(n_z, 3 * n);
    if (options.residual_rate)
      W_d = rows_along(W, across, n);

    // q'' = -2 zeta w v - w^2 q + Psi^T (X_q q + X_z z)
    DenseMatrix Psi_T(m, 3 * n);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int k = 0; k < m; ++k)
        Psi_T(k, i) = Psi(i, k);
    const bool has_states =
        n_z > 0 && (options.lateral_damping || n_stick > 0) && (options.residual_rate || n_stick > 0);
    DenseMatrix A(2 * m + (has_states ? n_z : 0));
    for (unsigned int k = 0; k < m; ++k)
    {
      A(k, m + k) = 1;
      A(m + k, k) = -pair.omega[k] * pair.omega[k];
      A(m + k, m + k) = -2 * pair.damping_ratio[k] * pair.omega[k];
    }
    for (unsigned int d = 0; pair.hub && d < 3; ++d)
      for (unsigned int j = 0; j < pair.hub->shapes.n(); ++j)
        for (unsigned int k = 0; k < pair.hub->shapes.n(); ++k)
          A(m + k, m + j) -= pair.hub->damping[d] * pair.hub->motion(d, k) * pair.hub->motion(d, j);
    add_block(A, product(Psi_T, X_q), m, 0);
    add_block(A, product(Psi_T, X_v), m, m);
    if (n_z == 0)
      return A;

    DenseMatrix slip_q = product(S_r, X_q), slip_v = product(W_d, X_q), slip_z = product(S_r, X_z);
    slip_q.add(1., S_q);
    slip_v.add(1., Psi_d);
    slip_v.add(1., product(S_r, X_v));
    if (has_states)
    {
      // W_d X_z z' = -(slip_q q + slip_v v + slip_z z) - mobility z - W_d X_v v'
      add_block(A, product(Psi_T, X_z), m, 2 * m);
      for (unsigned int k = 0; k < n_z; ++k)
        slip_z(k, k) += frame.mobility[k];
      DenseMatrix right(n_z, 2 * m + n_z);
      add_block(right, slip_q, 0, 0, -1);
      add_block(right, slip_v, 0, m, -1);
      add_block(right, slip_z, 0, 2 * m, -1);
      if (!frame.along.empty())
      {
        DenseMatrix acceleration(m, 2 * m + n_z);
        for (unsigned int j = 0; j < 2 * m + n_z; ++j)
          for (unsigned int k = 0; k < m; ++k)
            acceleration(k, j) = A(m + k, j);
        add_block(right, product(product(W_d, X_v), acceleration), 0, 0, -1);
      }
      add_block(A, solve(product(W_d, X_z), right, "tangential flexibility"), 2 * m, 0);
    }
    else
    {
      // mobility z = -(slip_q q + Psi_d v + slip_z z) is no state; the paper's C_b, whose effect on N is left
      // out
      for (unsigned int k = 0; k < n_z; ++k)
        slip_z(k, k) += frame.mobility[k];
      DenseMatrix right(n_z, 2 * m);
      add_block(right, slip_q, 0, 0, -1);
      add_block(right, slip_v, 0, m, -1);
      const DenseMatrix z = solve(slip_z, right, "sliding mobility");
      add_block(A, product(product(Psi_T, options.convection ? X_z : E_z), z), m, 0);
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
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < lambda.values.size(); ++k)
    {
      if (!is_listed(lambda.values[k]))
        continue;
      std::vector<std::complex<double>> amplitudes;
      for (unsigned int i = 0; i < pair.n_modes(); ++i)
        amplitudes.push_back(lambda.component(i, k));
      roots.push_back(named_root(lambda.values[k], std::move(amplitudes), pair.omega, pair.labels));
    }
    sort_roots(roots);
    return roots;
  }
} // namespace vibrocontact
