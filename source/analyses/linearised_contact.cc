#include <vibrocontact/analyses/linearised_contact.h>
#include <vibrocontact/base/exceptions.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    // rows of a matrix, each a combination of the rows of x and y of a point: direction . (row_x, row_y)
    struct Direction
    {
      unsigned int point;
      double x, y;
    };

    DenseMatrix along(const DenseMatrix &matrix, const std::vector<Direction> &directions,
                      const unsigned int n)
    {
      DenseMatrix result(directions.size(), matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int k = 0; k < directions.size(); ++k)
          result(k, j) = directions[k].x * matrix(n + directions[k].point, j) +
                         directions[k].y * matrix(2 * n + directions[k].point, j);
      return result;
    }

    DenseMatrix rows(const DenseMatrix &matrix, const std::vector<unsigned int> &points)
    {
      DenseMatrix result(points.size(), matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int k = 0; k < points.size(); ++k)
          result(k, j) = matrix(points[k], j);
      return result;
    }

    DenseMatrix product(const DenseMatrix &a, const DenseMatrix &b)
    {
      DenseMatrix c(a.m(), b.n());
      if (a.m() > 0 && b.n() > 0 && a.n() > 0)
        a.mmult(c, b);
      return c;
    }

    void insert(DenseMatrix &into, const DenseMatrix &block, const unsigned int row,
                const unsigned int column, const double factor = 1)
    {
      for (unsigned int j = 0; j < block.n(); ++j)
        for (unsigned int i = 0; i < block.m(); ++i)
          into(row + i, column + j) += factor * block(i, j);
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

    // inverse(G) b; with a given force the approach adds a constant to b that makes the columns sum to zero
    DenseMatrix close_gaps(const DenseMatrix &G, const DenseMatrix &b, const bool force_given)
    {
      if (G.m() == 0 || b.n() == 0)
        return b;
      DenseMatrix right(b.m(), b.n() + 1);
      insert(right, b, 0, 0);
      for (unsigned int i = 0; i < b.m(); ++i)
        right(i, b.n()) = 1;
      const DenseMatrix x = solve(G, right, "normal flexibility");
      const auto sum = [&](const unsigned int column)
      {
        double result = 0;
        for (unsigned int i = 0; i < x.m(); ++i)
          result += x(i, column);
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

  DenseMatrix linearised_contact(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const LinearisationOptions &options)
  {
    const unsigned int n = pair.n_points(), m = pair.n_modes();
    const ContactSolution &contact = equilibrium.contact;
    const DenseMatrix &W = pair.residual_flexibility, &Psi = pair.modal_trace;

    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < n; ++i)
      if (contact.status[i] != ContactStatus::open && contact.R[i] > 0)
        points.push_back(i);
    const unsigned int c = points.size();

    // R = E_N N + E_z z: friction that follows the normal force, and the states z of friction along
    // directions
    DenseMatrix E_N(3 * n, c);
    std::vector<Direction> directions;
    std::vector<double> mobility; // 1 / c_b, zero at sticking points
    unsigned int n_stick = 0;
    for (unsigned int k = 0; k < c; ++k)
    {
      const unsigned int i = points[k];
      E_N(i, k) = 1;
      const double mu = equilibrium.friction[i];
      if (mu == 0)
        continue;
      const double sx = contact.y[n + i], sy = contact.y[2 * n + i], s = std::hypot(sx, sy);
      if (contact.status[i] == ContactStatus::stick || s == 0)
      {
        ++n_stick;
        directions.push_back({i, 1, 0});
        directions.push_back({i, 0, 1});
        mobility.insert(mobility.end(), 2, 0.);
        continue;
      }
      E_N(n + i, k) = -mu * sx / s;
      E_N(2 * n + i, k) = -mu * sy / s;
      if (!options.lateral_damping)
        continue;
      directions.push_back({i, -sy / s, sx / s});
      mobility.push_back(s / (mu * contact.R[i]));
    }
    if (n_stick > 0 && !options.stick)
      throw InputError(
          "The equilibrium is not in full sliding (" + std::to_string(n_stick) + " of " + std::to_string(c) +
          " points stick): raise the creepage, or set Stability/Linearise sticking points to true.");
    if (n_stick > 0 && !options.residual_rate)
      throw InputError("Points stick at the equilibrium, which only the consistent linearisation takes: set "
                       "Stability/Linearisation to consistent.");
    const unsigned int n_z = directions.size();
    DenseMatrix E_z(3 * n, n_z);
    for (unsigned int k = 0; k < n_z; ++k)
    {
      E_z(n + directions[k].point, k) = directions[k].x;
      E_z(2 * n + directions[k].point, k) = directions[k].y;
    }

    // R = X_q q + X_z z from the closed gaps
    const DenseMatrix W_n = rows(W, points), G = product(W_n, E_N);
    const bool force_given = equilibrium.force_given;
    DenseMatrix X_q = product(E_N, close_gaps(G, rows(Psi, points), force_given));
    X_q *= -1;
    DenseMatrix X_z = product(E_N, close_gaps(G, product(W_n, E_z), force_given));
    X_z *= -1;
    X_z.add(1., E_z);

    // slip along the directions: ds = S_q q + S_r R + Psi_d v + W_d R'
    const DenseMatrix Psi_d = along(Psi, directions, n);
    DenseMatrix W_d(n_z, 3 * n), S_q(n_z, m), S_r(n_z, 3 * n);
    if (options.residual_rate)
      W_d = along(W, directions, n);
    if (options.convection)
    {
      DenseMatrix slip_q = Psi, slip_r = W;
      convert_to_slip_rows(pair.interface.grid, scheme, equilibrium.speed, slip_q);
      convert_to_slip_rows(pair.interface.grid, scheme, equilibrium.speed, slip_r);
      S_q = along(slip_q, directions, n);
      S_r = along(slip_r, directions, n);
    }

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
    insert(A, product(Psi_T, X_q), m, 0);
    if (n_z == 0)
      return A;

    DenseMatrix slip_q = product(S_r, X_q), slip_v = product(W_d, X_q), slip_z = product(S_r, X_z);
    slip_q.add(1., S_q);
    slip_v.add(1., Psi_d);
    if (has_states)
    {
      // W_d X_z z' = -(slip_q q + slip_v v + slip_z z) - mobility z
      insert(A, product(Psi_T, X_z), m, 2 * m);
      for (unsigned int k = 0; k < n_z; ++k)
        slip_z(k, k) += mobility[k];
      DenseMatrix right(n_z, 2 * m + n_z);
      insert(right, slip_q, 0, 0, -1);
      insert(right, slip_v, 0, m, -1);
      insert(right, slip_z, 0, 2 * m, -1);
      insert(A, solve(product(W_d, X_z), right, "tangential flexibility"), 2 * m, 0);
    }
    else
    {
      // mobility z = -(slip_q q + Psi_d v + slip_z z) is no state; the paper's C_b, whose effect on N is left
      // out
      for (unsigned int k = 0; k < n_z; ++k)
        slip_z(k, k) += mobility[k];
      DenseMatrix right(n_z, 2 * m);
      insert(right, slip_q, 0, 0, -1);
      insert(right, Psi_d, 0, m, -1);
      const DenseMatrix z = solve(slip_z, right, "sliding mobility");
      insert(A, product(product(Psi_T, options.convection ? X_z : E_z), z), m, 0);
    }
    return A;
  }

  std::vector<StabilityRoot> stability_roots(const ContactPair &pair, DenseMatrix linearised)
  {
    const unsigned int m = pair.n_modes();
    const dealii::types::blas_int size = linearised.m();
    std::vector<double> real(size), imaginary(size), vectors(size * size), work(1);
    dealii::types::blas_int info = 0, n_work = -1;
    double none = 0;
    const dealii::types::blas_int one = 1;
    for (unsigned int pass = 0; pass < 2; ++pass)
    {
      dealii::geev("N", "V", &size, &linearised(0, 0), &size, real.data(), imaginary.data(), &none, &one,
                   vectors.data(), &size, work.data(), &n_work, &info);
      if (pass == 0)
      {
        n_work = static_cast<dealii::types::blas_int>(work[0]);
        work.resize(n_work);
      }
    }
    if (info != 0)
      throw ConvergenceError(
          "LAPACK found no eigenvalues of the linearised contact (dgeev: " + std::to_string(info) + ").");
    std::vector<StabilityRoot> roots, still;
    for (unsigned int k = 0; k < linearised.m(); ++k)
    {
      const std::complex<double> lambda(real[k], imaginary[k]);
      if (lambda.imag() < 0 || (lambda.imag() == 0 && lambda.real() <= 0))
        continue;
      StabilityRoot root;
      root.frequency = lambda.imag() / (2 * dealii::numbers::PI);
      root.growth = lambda.real();
      root.divergence_rate = lambda.imag() > 0 ? lambda.real() / lambda.imag() : 0;
      double sum = 0, largest = 0;
      for (unsigned int i = 0; i < m; ++i)
      {
        // a conjugate pair holds real and imaginary part in two columns
        root.shape.emplace_back(vectors[k * size + i], imaginary[k] > 0 ? vectors[(k + 1) * size + i] : 0.);
        const double energy =
            std::norm(root.shape.back()) * (pair.omega[i] * pair.omega[i] + std::norm(lambda));
        sum += energy;
        if (energy > largest)
        {
          largest = energy;
          root.label = pair.labels[i];
        }
      }
      root.share = sum > 0 ? largest / sum : 0;
      (lambda.imag() > 0 ? roots : still).push_back(std::move(root));
    }
    const auto ascending = [](const StabilityRoot &a, const StabilityRoot &b)
    { return a.frequency < b.frequency; };
    std::stable_sort(roots.begin(), roots.end(), ascending);
    roots.insert(roots.end(), still.begin(), still.end());
    return roots;
  }
} // namespace vibrocontact
