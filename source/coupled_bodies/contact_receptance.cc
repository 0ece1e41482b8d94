#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/coupled_bodies/contact_receptance.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  ComplexMatrix ContactReceptance::Rows::at(const Complex &s) const
  {
    ComplexMatrix result = constant;
    result.add(s, linear);
    return result;
  }

  namespace
  {
    /// a b, where b has few entries in a column: forces at a point
    template <typename Number>
    dealii::LAPACKFullMatrix<Number> by_points(const dealii::LAPACKFullMatrix<Number> &a,
                                               const DenseMatrix &b)
    {
      dealii::LAPACKFullMatrix<Number> c(a.m(), b.n());
      for (unsigned int j = 0; j < b.n(); ++j)
        for (unsigned int k = 0; k < b.m(); ++k)
          if (const double factor = b(k, j); factor != 0)
            for (unsigned int i = 0; i < a.m(); ++i)
              c(i, j) += factor * a(i, k);
      return c;
    }

    std::vector<PatchReceptance> together(std::vector<PatchReceptance> some,
                                          std::vector<PatchReceptance> others)
    {
      std::move(others.begin(), others.end(), std::back_inserter(some));
      return some;
    }
  } // namespace

  ContactReceptance::ContactReceptance(const ContactPair &pair, const CreepScheme &scheme,
                                       const RollingEquilibrium &equilibrium, const HystereticLoss *loss,
                                       std::vector<PatchReceptance> further)
      : ContactReceptance(pair, scheme, equilibrium,
                          together(patch_receptances(pair, loss), std::move(further)), loss)
  {
  }

  ContactReceptance::ContactReceptance(const ContactPair &pair, const CreepScheme &scheme,
                                       const RollingEquilibrium &equilibrium,
                                       std::vector<PatchReceptance> receptances, const HystereticLoss *loss)
  {
    const unsigned int n = pair.n_points();
    const SlidingFrame frame = sliding_frame(equilibrium);
    const unsigned int c = frame.points.size(), n_z = frame.across.size(),
                       size = c + n_z + (equilibrium.force_given ? 1 : 0);
    DenseMatrix E(3 * n, size);
    add_block(E, frame.normal, 0, 0);
    add_block(E, forces_along(frame.across, n), 0, c);

    // rows of gap and of V d/dx slip, rows of slip rate
    const auto split = [&](const ComplexMatrix &response)
    {
      const auto constant = [&](const DenseMatrix &part)
      {
        DenseMatrix moved = part, rows(size, part.n());
        convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, moved);
        for (unsigned int j = 0; j < part.n(); ++j)
          for (unsigned int k = 0; k < c; ++k)
            rows(k, j) = part(frame.points[k], j);
        add_block(rows, rows_along(moved, frame.across, n), c, 0);
        return rows;
      };
      const auto linear = [&](const DenseMatrix &part)
      {
        DenseMatrix rows(size, part.n());
        add_block(rows, rows_along(part, frame.across, n), c, 0);
        return rows;
      };
      return Rows{mapped(response, constant), mapped(response, linear)};
    };
    // what V d/dx is beyond the differences between points
    const auto add_gradient = [&](const DenseMatrix &gradient, Rows &rows)
    {
      if (gradient.m() > 0)
        add_block(rows.constant, entries_as<Complex>(rows_along(gradient, frame.across, n)), c, 0,
                  equilibrium.speed);
    };
    const DenseMatrix W = vibrocontact::at_once(compliance_of_contact(pair, equilibrium), pair.relaxing);
    at_once = split(loss ? by_points(compliance_of_contact(*loss, equilibrium), E)
                         : entries_as<Complex>(by_points(W, E)));
    if (pair.residual_gradient.m() > 0)
      add_gradient(by_points(pair.residual_gradient, E), at_once);
    for (const RelaxingRest &rest : pair.relaxing)
      rests.push_back({rest.relaxation, split(entries_as<Complex>(by_points(rest.flexibility, E)))});
    for (PatchReceptance &receptance : receptances)
    {
      const DenseMatrix &basis = receptance.basis, &forces = receptance.shapes_of_forces();
      if (basis.n() == 0)
        continue;
      if (&receptance == receptances.data())
        first = bodies.size();
      DenseMatrix shares(forces.n(), size);
      forces.Tmmult(shares, E);
      Rows rows = split(entries_as<Complex>(basis));
      add_gradient(receptance.gradient, rows);
      bodies.push_back({std::move(receptance), std::move(rows), entries_as<Complex>(shares)});
    }
    for (unsigned int k = 0; k < n_z; ++k)
      at_once.constant(c + k, c + k) += frame.mobility[k];
    for (const unsigned int i : frame.points)
      places.push_back(3 * i);
    for (unsigned int k = 0; k < n_z; ++k)
    {
      const bool second = k > 0 && frame.across[k - 1].point == frame.across[k].point;
      places.push_back(3 * frame.across[k].point + (second ? 2 : 1));
    }
    if (equilibrium.force_given)
      places.push_back(3 * n);
    const std::vector<double> hub = gaps_by_approach(pair, frame.points);
    if (equilibrium.force_given)
      for (unsigned int k = 0; k < c; ++k)
        at_once.constant(k, size - 1) = at_once.constant(size - 1, k) = hub[k];
    // slips of what follows forces at once grow as s, gaps that only relax fall as 1 / s
    power_of_s = pair.relaxing.empty() ? n_z : followed_at_once(W, frame.across, n).size();
    int n_relaxing = 0;
    for (const unsigned int i : frame.points)
      n_relaxing += !pair.relaxing.empty() && W(i, i) == 0;
    power_of_s -= n_relaxing - (equilibrium.force_given && n_relaxing > 0);
  }

  ComplexMatrix ContactReceptance::value(const Complex &s) const
  {
    return value_without(bodies.size(), s);
  }

  ComplexMatrix ContactReceptance::value_without(const std::size_t left_out, const Complex &s) const
  {
    ComplexMatrix F = at_once.at(s);
    for (const Rest &rest : rests)
      F.add(1. / (1. + rest.relaxation * s), rest.rows.at(s));
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (const Body &body = bodies[b]; b != left_out)
        F.add(1., product(body.rows.at(s), product(body.receptance.value(s), body.shares)));
    return F;
  }

  ComplexMatrix ContactReceptance::seen_by_first(const Complex &s) const
  {
    const Body &body = bodies.at(first);
    ComplexMatrix F = value_without(first, s), rows = body.rows.at(s);
    F.compute_lu_factorization();
    F.solve(rows);
    return product(body.shares, rows);
  }

  namespace
  {
    /// of an analytic function, error (h^4) with h = 1e-3 |s|
    ComplexMatrix differenced(const PatchReceptance::Function &f, const Complex &s)
    {
      const double h = 1e-3 * std::abs(s);
      ComplexMatrix result = f(s + h);
      result.add(-1., f(s - h));
      // the same along the imaginary axis, where the error of third order has the opposite sign
      result.add(Complex(0, -1), f(s + Complex(0, h)));
      result.add(Complex(0, 1), f(s - Complex(0, h)));
      ComplexMatrix scaled(result.m(), result.n());
      scaled.add(1 / (4 * h), result);
      return scaled;
    }
  } // namespace

  ComplexMatrix ContactReceptance::derivative(const Complex &s) const
  {
    ComplexMatrix result = at_once.linear;
    for (const Rest &rest : rests)
    {
      const Complex share = 1. / (1. + rest.relaxation * s);
      result.add(share, rest.rows.linear);
      result.add(-rest.relaxation * share * share, rest.rows.at(s));
    }
    for (const Body &body : bodies)
    {
      const PatchReceptance &G = body.receptance;
      const ComplexMatrix slope = G.derivative ? G.derivative(s) : differenced(G.value, s);
      result.add(1., product(body.rows.linear, product(G.value(s), body.shares)));
      result.add(1., product(body.rows.at(s), product(slope, body.shares)));
    }
    return result;
  }

  namespace
  {
    /// (constant + s linear) v
    template <typename Rows>
    void add_rows(const Rows &rows, const Complex &s, const ComplexVector &v, const Complex &factor,
                  ComplexVector &y)
    {
      y.add(factor, product(rows.constant, v));
      y.add(factor * s, product(rows.linear, v));
    }
    ComplexVector receptance_times(const PatchReceptance &G, const Complex &s, const ComplexVector &v)
    {
      return G.times ? G.times(s, v) : product(G.value(s), v);
    }
  } // namespace

  ComplexVector ContactReceptance::times(const Complex &s, const ComplexVector &x) const
  {
    ComplexVector y(size());
    add_rows(at_once, s, x, 1., y);
    for (const Rest &rest : rests)
      add_rows(rest.rows, s, x, 1. / (1. + rest.relaxation * s), y);
    for (const Body &body : bodies)
      add_rows(body.rows, s, receptance_times(body.receptance, s, product(body.shares, x)), 1., y);
    return y;
  }

  ComplexVector ContactReceptance::derivative_times(const Complex &s, const ComplexVector &x) const
  {
    ComplexVector y = product(at_once.linear, x);
    for (const Rest &rest : rests)
    {
      const Complex share = 1. / (1. + rest.relaxation * s);
      y.add(share, product(rest.rows.linear, x));
      add_rows(rest.rows, s, x, -rest.relaxation * share * share, y);
    }
    for (const Body &body : bodies)
    {
      const PatchReceptance &G = body.receptance;
      const ComplexVector moved = product(body.shares, x);
      y.add(1., product(body.rows.linear, receptance_times(G, s, moved)));
      add_rows(body.rows, s,
               G.derivative_times ? G.derivative_times(s, moved)
                                  : product(G.derivative ? G.derivative(s) : differenced(G.value, s), moved),
               1., y);
    }
    return y;
  }
} // namespace vibrocontact
