#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/linearised_contact.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <utility>

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
    /// Closed gaps in x and R: by_x x + by_R R = hub * (motion of the hub). Where nothing follows forces at once, that is the
    /// gap's rate plus the gap over beta, in which s drops out, and the hub's motion is meant likewise.
    struct ClosedGaps
    {
      DenseMatrix by_x, by_R;
    };

    ClosedGaps closed_gaps(const PairMotion &motion, const DenseMatrix &W,
                           const std::vector<RelaxingRest> &rests, const std::vector<unsigned int> &points,
                           const bool force_given)
    {
      ClosedGaps gaps{rows(motion.displacement, points), rows(W, points)};
      unsigned int n_by_rate = 0;
      for (unsigned int k = 0; k < points.size() && motion.rest_rate.m() > 0; ++k)
      {
        const unsigned int i = points[k];
        const auto own = std::find_if(rests.begin(), rests.end(),
                                      [i](const RelaxingRest &rest) { return rest.flexibility(i, i) > 0; });
        if (W(i, i) != 0 || own == rests.end())
          continue;
        ++n_by_rate;
        for (unsigned int j = 0; j < motion.rate.n(); ++j)
          gaps.by_x(k, j) =
              motion.rate(i, j) + motion.rest_rate(i, j) + motion.displacement(i, j) / own->relaxation;
        for (unsigned int j = 0; j < W.n(); ++j)
          gaps.by_R(k, j) =
              motion.rest_rate_at_once(i, j) + (motion.rate_at_once.m() > 0 ? motion.rate_at_once(i, j) : 0.);
      }
      if (force_given && n_by_rate > 0 && n_by_rate < points.size())
        throw InputError(
            "Some closed contact points follow forces at once and others relax (Modes/Stiffness "
            "damping), which Stability does not take under a given normal force: set Rolling/Hub to held, "
            "or leave the Stiffness damping out.");
      return gaps;
    }

    std::vector<ContactDirection> chosen(const std::vector<ContactDirection> &all,
                                         const std::vector<unsigned int> &places)
    {
      std::vector<ContactDirection> result;
      for (const unsigned int k : places)
        result.push_back(all[k]);
      return result;
    }

    DenseMatrix columns(const DenseMatrix &matrix, const std::vector<unsigned int> &places)
    {
      DenseMatrix result(matrix.m(), places.size());
      for (unsigned int j = 0; j < places.size(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          result(i, j) = matrix(i, places[j]);
      return result;
    }

    /// Forces R = by_x x + by_s s that close the gaps, s along some directions, with their mobilities.
    struct ClosedForces
    {
      std::vector<ContactDirection> across;
      std::vector<double> mobility;
      DenseMatrix by_x, by_s;

      /// Slip along them, S_x x + S_R R + mobility s, of forces alone: by x and by s.
      std::pair<DenseMatrix, DenseMatrix> slip(const DenseMatrix &slip_by_x, const DenseMatrix &slip_by_R,
                                               const unsigned int n) const
      {
        const DenseMatrix S_R = rows_along(slip_by_R, across, n);
        DenseMatrix by_states = product(S_R, by_x), by_own = product(S_R, by_s);
        by_states.add(1., rows_along(slip_by_x, across, n));
        for (unsigned int k = 0; k < across.size(); ++k)
          by_own(k, k) += mobility[k];
        return {by_states, by_own};
      }
    };

    /// Forces along directions that only rests that relax give way in follow from the slip without its rate of W R: they
    /// are no states.
    ClosedForces without_relaxing(const ClosedForces &all, const DenseMatrix &slip_by_x,
                                  const DenseMatrix &slip_by_R, const DenseMatrix &W, const unsigned int n)
    {
      const std::vector<unsigned int> kept = followed_at_once(W, all.across, n);
      std::vector<unsigned int> dropped;
      for (unsigned int k = 0; k < all.across.size(); ++k)
        if (!std::binary_search(kept.begin(), kept.end(), k))
          dropped.push_back(k);
      if (dropped.empty())
        return all;
      ClosedForces result;
      result.across = chosen(all.across, kept);
      for (const unsigned int k : kept)
        result.mobility.push_back(all.mobility[k]);
      const auto [by_x, by_s] = all.slip(slip_by_x, slip_by_R, n);
      const DenseMatrix own = columns(rows(by_s, dropped), dropped), shapes = columns(all.by_s, dropped);
      const auto eliminated = [&](const DenseMatrix &R, const DenseMatrix &slip)
      {
        DenseMatrix forces = R;
        forces.add(-1.,
                   product(shapes, solve(own, rows(slip, dropped), "rate of the tangential flexibility")));
        return forces;
      };
      result.by_x = eliminated(all.by_x, by_x);
      result.by_s = kept.empty() ? DenseMatrix(all.by_s.m(), 0)
                                 : eliminated(columns(all.by_s, kept), columns(by_s, kept));
      return result;
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
    // without their rate rests are where they would come to
    const std::vector<RelaxingRest> rests =
        options.residual_rate ? pair.relaxing : std::vector<RelaxingRest>();
    const DenseMatrix W = at_once(compliance_of_contact(pair, equilibrium), rests);

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
    // R = E_N N + E_z s + E_x x; the last from friction that falls with the speed, itself among R
    DenseMatrix E_N = frame.normal, E_z = forces_along(frame.across, n);

    // slip by x and R: V d/dx of the displacements, and rates; that of W R comes with R'
    const PairMotion motion = pair_motion(pair, rests, span_of_forces(frame, n));
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

    DenseMatrix E_x(3 * n, n_x);
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

    if (motion.rest_rate.m() > 0)
    {
      slip_by_x.add(1., motion.rest_rate);
      slip_by_R.add(1., motion.rest_rate_at_once);
    }

    // R = X_x x + X_z s from the closed gaps
    const ClosedGaps gaps = closed_gaps(motion, W, rests, points, equilibrium.force_given);
    const DenseMatrix G = product(gaps.by_R, E_N);
    const std::vector<double> hub = gaps_by_approach(pair, points);
    const auto closed = [&](const DenseMatrix &E, const DenseMatrix *const gap)
    {
      if (E.n() == 0)
        return E;
      DenseMatrix opened = product(gaps.by_R, E);
      if (gap)
        opened.add(1., *gap);
      DenseMatrix X = product(E_N, close_gaps(G, opened, equilibrium.force_given, hub));
      X *= -1;
      X.add(1., E);
      return X;
    };
    ClosedForces forces{frame.across, frame.mobility, closed(E_x, &gaps.by_x), closed(E_z, nullptr)};
    if (!rests.empty())
      forces = without_relaxing(forces, slip_by_x, slip_by_R, W, n);
    const DenseMatrix &X_x = forces.by_x, &X_z = forces.by_s;
    const std::vector<ContactDirection> &across = forces.across;
    const unsigned int n_z = across.size();

    // slip across t: ds = S_x x + S_r R + W_d R'
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

    auto [slip_x, slip_z] = forces.slip(slip_by_x, slip_by_R, n);
    if (has_states)
    {
      // W_d X_z s' = -slip_x x - (slip_z + mobility) s - W_d X_x x'
      add_block(A, product(motion.input, X_z), m, n_x);
      const DenseMatrix by_rates = product(W_d, X_x);
      DenseMatrix right(n_z, n_x + n_z);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int k = 0; k < n_z; ++k)
          right(k, m + j) = -by_rates(k, j); // q' = v
      if (!frame.along.empty() || pair.n_poles() > 0 || !rests.empty())
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
      // gaps that are not closed decay by 1 / beta
      const bool is_closing = std::any_of(
          pair.relaxing.begin(), pair.relaxing.end(),
          [&](const RelaxingRest &rest) { return std::abs(lambda.values[k] * rest.relaxation + 1.) < 1e-6; });
      if (!is_listed(lambda.values[k]) || is_closing)
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
