#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/coupled_bodies/linearised_contact.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// real, or complex with hysteretic loss
    template <typename Number>
    using Matrix = dealii::LAPACKFullMatrix<Number>;

    template <typename Number>
    Matrix<Number> solve(const Matrix<Number> &a, const Matrix<Number> &b, const std::string &what)
    {
      return solved(a, b,
                    "The linearised contact has a singular " + what +
                        ": the residual flexibility does not hold the contact points; keep fewer modes.");
    }

    /// Below this share of the compliance it is a part of, a flexibility is what rounding and inexact modes leave of a
    /// difference.
    constexpr double rounded = 1e-11;

    /// The largest static displacement of a contact point per force on itself [m/N], but for motions on soft springs, which say
    /// nothing of what the flexibility was a part of: modes far below the highest.
    template <typename Number>
    double compliance_of_points(const ContactPair &pair, const Matrix<Number> &W)
    {
      constexpr double far_below = 3e-4;
      const double highest =
          pair.omega.empty() ? 0. : *std::max_element(pair.omega.begin(), pair.omega.end());
      double largest = 0;
      for (unsigned int i = 0; i < W.m(); ++i)
      {
        double own = std::abs(W(i, i));
        for (unsigned int k = 0; k < pair.n_modes(); ++k)
          if (pair.omega[k] > far_below * highest)
            own += std::pow(pair.trace(i, k) / pair.omega[k], 2);
        largest = std::max(largest, own);
      }
      return largest;
    }

    /// the 1-norm, which deal.II does not have of complex matrices (its release library says 0)
    template <typename Number>
    double largest_column_sum(const Matrix<Number> &matrix)
    {
      double largest = 0;
      for (unsigned int j = 0; j < matrix.n(); ++j)
      {
        double sum = 0;
        for (unsigned int i = 0; i < matrix.m(); ++i)
          sum += std::abs(matrix(i, j));
        largest = std::max(largest, sum);
      }
      return largest;
    }

    /// a^-1 b of a flexibility. @param compliance that it is a part of [m/N]
    /// @throws ConvergenceError if it is singular to what rounding left of it
    template <typename Number>
    Matrix<Number> solve_flexibility(const Matrix<Number> &a, const Matrix<Number> &b,
                                     const std::string &what, const double compliance)
    {
      if (a.m() == 0 || b.n() == 0)
        return b;
      const unsigned int n = a.m();
      Matrix<Number> right(n, b.n() + n);
      add_block(right, b, 0, 0);
      for (unsigned int i = 0; i < n; ++i)
        right(i, b.n() + i) = 1;
      const Matrix<Number> both = solve(a, right, what);
      Matrix<Number> result(n, b.n()), inverse(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < both.n(); ++j)
          (j < b.n() ? result(i, j) : inverse(i, j - b.n())) = both(i, j);
      if (!(largest_column_sum(inverse) * rounded * compliance < 1))
        throw ConvergenceError(
            "The modes that are kept leave no " + what +
            " of the contact points but rounding: keep fewer modes (Modes/Count or Upper frequency).");
      return result;
    }

    template <typename Number>
    Matrix<Number> difference(Matrix<Number> a, const Matrix<Number> &b)
    {
      if (b.m() > 0 && b.n() > 0)
        a.add(-1., b);
      return a;
    }

    // inverse(G) b; with a given force the approach moves the gaps by `hub`, along which the columns then sum to zero
    template <typename Number>
    Matrix<Number> close_gaps(const Matrix<Number> &G, const Matrix<Number> &b, const bool force_given,
                              const std::vector<double> &hub, const double compliance)
    {
      if (G.m() == 0 || b.n() == 0)
        return b;
      Matrix<Number> right(b.m(), b.n() + 1);
      add_block(right, b, 0, 0);
      for (unsigned int i = 0; i < b.m(); ++i)
        right(i, b.n()) = hub[i];
      const Matrix<Number> x = solve_flexibility(G, right, "normal flexibility", compliance);
      const auto sum = [&](const unsigned int column)
      {
        Number result = 0;
        for (unsigned int i = 0; i < x.m(); ++i)
          result += hub[i] * x(i, column);
        return result;
      };
      const Number approach = sum(b.n());
      Matrix<Number> result(b.m(), b.n());
      for (unsigned int j = 0; j < b.n(); ++j)
      {
        const Number share = force_given ? sum(j) / approach : Number();
        for (unsigned int i = 0; i < b.m(); ++i)
          result(i, j) = x(i, j) - share * x(i, b.n());
      }
      return result;
    }

    /// Closed gaps in x and R: by_x x + by_R R = hub * (motion of the hub). Where nothing follows forces at once, that is the
    /// gap's rate plus the gap over beta, in which s drops out, and the hub's motion is meant likewise.
    template <typename Number>
    struct ClosedGaps
    {
      Matrix<Number> by_x, by_R;
      /// what the flexibility in by_R is a part of [m/N]; 0: by_R is of rates
      double compliance;
    };

    template <typename Number>
    ClosedGaps<Number> closed_gaps(const ContactPair &pair, const PairMotion &motion, const Matrix<Number> &W,
                                   const std::vector<RelaxingRest> &rests,
                                   const std::vector<unsigned int> &points, const bool force_given)
    {
      ClosedGaps<Number> gaps{entries_as<Number>(rows_at(motion.displacement, points)), rows_at(W, points),
                              compliance_of_points(pair, W)};
      unsigned int n_by_rate = 0;
      for (unsigned int k = 0; k < points.size() && motion.rest_rate.m() > 0; ++k)
      {
        const unsigned int i = points[k];
        const auto own = std::find_if(rests.begin(), rests.end(),
                                      [i](const RelaxingRest &rest) { return rest.flexibility(i, i) > 0; });
        if (W(i, i) != 0. || own == rests.end())
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
      if (n_by_rate > 0)
        gaps.compliance = 0;
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

    template <typename Number>
    Matrix<Number> along_directions(const Matrix<Number> &matrix,
                                    const std::vector<ContactDirection> &directions, const unsigned int n)
    {
      return mapped(matrix, [&](const DenseMatrix &part) { return rows_along(part, directions, n); });
    }

    /// Forces R = by_x x + by_s s that close the gaps, s along some directions, with their mobilities.
    template <typename Number>
    struct ClosedForces
    {
      std::vector<ContactDirection> across;
      std::vector<double> mobility;
      Matrix<Number> by_x, by_s;

      /// Slip along them, S_x x + S_R R + mobility s, of forces alone: by x and by s.
      std::pair<Matrix<Number>, Matrix<Number>>
      slip(const Matrix<Number> &slip_by_x, const Matrix<Number> &slip_by_R, const unsigned int n) const
      {
        const Matrix<Number> S_R = along_directions(slip_by_R, across, n);
        Matrix<Number> by_states = product(S_R, by_x), by_own = product(S_R, by_s);
        by_states.add(1., along_directions(slip_by_x, across, n));
        for (unsigned int k = 0; k < across.size(); ++k)
          by_own(k, k) += mobility[k];
        return {by_states, by_own};
      }
    };

    /// Forces along directions that only rests that relax give way in follow from the slip without its rate of W R: they
    /// are no states.
    ClosedForces<double> without_relaxing(const ClosedForces<double> &all, const DenseMatrix &slip_by_x,
                                          const DenseMatrix &slip_by_R, const DenseMatrix &W,
                                          const unsigned int n)
    {
      const std::vector<unsigned int> kept = followed_at_once(W, all.across, n);
      std::vector<unsigned int> dropped;
      for (unsigned int k = 0; k < all.across.size(); ++k)
        if (!std::binary_search(kept.begin(), kept.end(), k))
          dropped.push_back(k);
      if (dropped.empty())
        return all;
      ClosedForces<double> result;
      result.across = chosen(all.across, kept);
      for (const unsigned int k : kept)
        result.mobility.push_back(all.mobility[k]);
      const auto [by_x, by_s] = all.slip(slip_by_x, slip_by_R, n);
      const DenseMatrix own = entries_at(by_s, dropped, dropped), shapes = columns_at(all.by_s, dropped);
      const auto eliminated = [&](const DenseMatrix &R, const DenseMatrix &slip)
      {
        return difference(
            R, product(shapes, solve(own, rows_at(slip, dropped), "rate of the tangential flexibility")));
      };
      result.by_x = eliminated(all.by_x, by_x);
      result.by_s = kept.empty() ? DenseMatrix(all.by_s.m(), 0)
                                 : eliminated(columns_at(all.by_s, kept), columns_at(by_s, kept));
      return result;
    }

    /// What V d/dx of poles and W~ is beyond the differences between points.
    template <typename Number>
    void add_gradients(const ContactPair &pair, const double speed, DenseMatrix &by_x, Matrix<Number> &by_R)
    {
      const ComplexMatrix &gradient = pair.gradient;
      for (unsigned int k = 0; k < gradient.n(); ++k)
        for (unsigned int i = 0; i < gradient.m(); ++i)
        {
          by_x(i, 2 * pair.n_modes() + k) += 2 * speed * gradient(i, k).real();
          by_x(i, 2 * pair.n_modes() + pair.n_poles() + k) -= 2 * speed * gradient(i, k).imag();
        }
      if (gradient.m() > 0)
        by_R.add(speed, entries_as<Number>(pair.residual_gradient));
    }
  } // namespace

  DenseMatrix compliance_of_contact(const ContactPair &pair, const RollingEquilibrium &equilibrium)
  {
    DenseMatrix W = pair.residual;
    for (unsigned int i = 0; i < equilibrium.normal_compliance.size(); ++i)
      W(i, i) += equilibrium.normal_compliance[i];
    return W;
  }

  ComplexMatrix compliance_of_contact(const HystereticLoss &loss, const RollingEquilibrium &equilibrium)
  {
    ComplexMatrix W = loss.residual;
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

  namespace
  {
    /// @param rests that relax, none with loss @param W of what follows forces at once
    /// @param transition of motion without contact
    template <typename Number>
    Matrix<Number> linearised(const ContactPair &pair, const CreepScheme &scheme,
                              const RollingEquilibrium &equilibrium, const LinearisationOptions &options,
                              const std::vector<RelaxingRest> &rests, const Matrix<Number> &W,
                              const std::function<Matrix<Number>(const DenseMatrix &)> &transition)
    {
      const unsigned int n = pair.n_points();
      SlidingFrame frame = sliding_frame(equilibrium);
      const std::vector<unsigned int> &points = frame.points;
      const unsigned int c = points.size(), n_stick = frame.n_stick;
      if (n_stick > 0 && !options.stick)
        throw InputError(
            "The equilibrium is not in full sliding (" + std::to_string(n_stick) + " of " +
            std::to_string(c) +
            " points stick): raise the creepage, or set Stability/Linearise sticking points to true.");
      if (n_stick > 0 && !options.residual_rate)
        throw InputError(
            "Points stick at the equilibrium, which only the consistent linearisation takes: set "
            "Stability/Linearisation to consistent.");
      if (!options.lateral_damping)
        frame.keep_sticking_only();
      // R = E_N N + E_z s + E_x x; the last from friction that falls with the speed, itself among R
      Matrix<Number> E_N = entries_as<Number>(frame.normal),
                     E_z = entries_as<Number>(forces_along(frame.across, n));

      // slip by x and R: V d/dx of the displacements, and rates; that of W R comes with R'
      const PairMotion motion = pair_motion(pair, rests, span_of_forces(frame, n));
      const unsigned int n_x = motion.transition.m(), m = pair.n_modes();
      DenseMatrix moved_slip(3 * n, n_x);
      Matrix<Number> slip_by_R(3 * n, 3 * n);
      if (options.convection)
      {
        const auto convect = [&](DenseMatrix rows)
        {
          convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, rows);
          return rows;
        };
        moved_slip = convect(motion.displacement);
        slip_by_R = mapped(W, convect);
        add_gradients(pair, equilibrium.speed, moved_slip, slip_by_R);
      }
      moved_slip.add(1., motion.rate);
      Matrix<Number> slip_by_x = entries_as<Number>(moved_slip);
      if (pair.n_poles() > 0)
        slip_by_R.add(1., entries_as<Number>(motion.rate_at_once));

      Matrix<Number> E_x(3 * n, n_x);
      if (!frame.along.empty())
      {
        DenseMatrix falling = forces_along(frame.along, n);
        for (unsigned int k = 0; k < frame.along.size(); ++k)
          for (unsigned int i = 0; i < 3 * n; ++i)
            falling(i, k) *= -frame.falling[k];
        const Matrix<Number> fall = entries_as<Number>(falling);
        E_x = product(fall, along_directions(slip_by_x, frame.along, n));
        if ((equilibrium.speed > 0 && options.convection) || pair.n_poles() > 0)
        {
          Matrix<Number> identity(3 * n, 3 * n);
          for (unsigned int i = 0; i < 3 * n; ++i)
            identity(i, i) = 1;
          const Matrix<Number> own =
              difference(identity, product(fall, along_directions(slip_by_R, frame.along, n)));
          for (Matrix<Number> *const E : {&E_N, &E_z, &E_x})
            *E = solve(own, *E, "friction that falls with the slip speed");
        }
      }

      if (motion.rest_rate.m() > 0)
      {
        slip_by_x.add(1., entries_as<Number>(motion.rest_rate));
        slip_by_R.add(1., entries_as<Number>(motion.rest_rate_at_once));
      }

      // R = X_x x + X_z s from the closed gaps
      const ClosedGaps<Number> gaps = closed_gaps(pair, motion, W, rests, points, equilibrium.force_given);
      const Matrix<Number> G = product(gaps.by_R, E_N);
      const std::vector<double> hub = gaps_by_approach(pair, points);
      const auto closed = [&](const Matrix<Number> &E, const Matrix<Number> *const gap)
      {
        if (E.n() == 0)
          return E;
        Matrix<Number> opened = product(gaps.by_R, E);
        if (gap && opened.m() > 0)
          opened.add(1., *gap);
        return difference(E,
                          product(E_N, close_gaps(G, opened, equilibrium.force_given, hub, gaps.compliance)));
      };
      ClosedForces<Number> forces{frame.across, frame.mobility, closed(E_x, &gaps.by_x),
                                  closed(E_z, nullptr)};
      if constexpr (std::is_same_v<Number, double>)
        if (!rests.empty())
          forces = without_relaxing(forces, slip_by_x, slip_by_R, W, n);
      const Matrix<Number> &X_x = forces.by_x, &X_z = forces.by_s;
      const std::vector<ContactDirection> &across = forces.across;
      const unsigned int n_z = across.size();

      // slip across t: ds = S_x x + S_r R + W_d R'
      Matrix<Number> W_d(n_z, 3 * n);
      if (options.residual_rate)
        W_d = along_directions(W, across, n);

      // x' = (transition + input X_x) x + input X_z s
      const bool has_states =
          n_z > 0 && (options.lateral_damping || n_stick > 0) && (options.residual_rate || n_stick > 0);
      const Matrix<Number> input = entries_as<Number>(motion.input);
      Matrix<Number> A(n_x + (has_states ? n_z : 0));
      add_block(A, transition(motion.transition), 0, 0);
      add_block(A, product(input, X_x), m, 0);
      if (n_z == 0)
        return A;

      auto [slip_x, slip_z] = forces.slip(slip_by_x, slip_by_R, n);
      if (has_states)
      {
        // W_d X_z s' = -slip_x x - (slip_z + mobility) s - W_d X_x x'
        add_block(A, product(input, X_z), m, n_x);
        const Matrix<Number> by_rates = product(W_d, X_x);
        Matrix<Number> right(n_z, n_x + n_z);
        for (unsigned int j = 0; j < m; ++j)
          for (unsigned int k = 0; k < n_z; ++k)
            right(k, m + j) = -by_rates(k, j); // q' = v
        if (!frame.along.empty() || pair.n_poles() > 0 || !rests.empty())
        {
          Matrix<Number> others(n_z, n_x - m), rates(n_x - m, n_x + n_z);
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
        add_block(A,
                  solve_flexibility(product(W_d, X_z), right, "tangential flexibility",
                                    compliance_of_points(pair, W)),
                  n_x, 0);
      }
      else
      {
        // (slip_z + mobility) s = -slip_x x is no state; the paper's C_b, whose effect on N is left out
        const Matrix<Number> z = solve(slip_z, slip_x, "sliding mobility");
        add_block(A, product(product(input, options.convection ? X_z : E_z), z), m, 0, -1);
      }
      return A;
    }
  } // namespace

  DenseMatrix linearised_contact(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const LinearisationOptions &options)
  {
    // without their rate rests are where they would come to
    const std::vector<RelaxingRest> rests =
        options.residual_rate ? pair.relaxing : std::vector<RelaxingRest>();
    return linearised<double>(pair, scheme, equilibrium, options, rests,
                              at_once(compliance_of_contact(pair, equilibrium), rests),
                              [](const DenseMatrix &transition) { return transition; });
  }

  ComplexMatrix linearised_contact(const ContactPair &pair, const HystereticLoss &loss,
                                   const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                   const LinearisationOptions &options)
  {
    using Complex = std::complex<double>;
    return linearised<Complex>(pair, scheme, equilibrium, options, {},
                               compliance_of_contact(loss, equilibrium),
                               [&](const DenseMatrix &elastic)
                               {
                                 ComplexMatrix transition = entries_as<Complex>(elastic);
                                 const unsigned int m = loss.modal.m();
                                 for (unsigned int j = 0; j < m; ++j)
                                   for (unsigned int i = 0; i < m; ++i)
                                     transition(m + i, j) -= Complex(0, loss.modal(i, j));
                                 return transition;
                               });
  }
} // namespace vibrocontact
