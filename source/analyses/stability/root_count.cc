#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>
#include <vibrocontact/coupled_bodies/patch_shapes.h>
#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// the count has to see what the eigenvalues see
    constexpr double shape_tolerance = 1e-11;

    /// F(s) = A_0 + s A_1 + (L_0 + s L_1) S diag(d(s)) S^T P,  d_i = 1 / (s^2 + 2 zeta_i w_i s + w_i^2),
    /// where Psi = B S, see PatchShapes; and (A_0 + s A_1) / (1 + beta s) of each rest that relaxes
    struct ReducedReceptance
    {
      struct Rest
      {
        double relaxation;
        DenseMatrix A_0, A_1;
      };
      DenseMatrix A_0, A_1, L_0, L_1, S, P;
      std::vector<Rest> rests;
      /// det F grows as s to this power
      int power = 0;
    };

    /// rows of normal gaps, then of slip along the directions
    ReducedReceptance receptance(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium)
    {
      const unsigned int n = pair.n_points();
      const SlidingFrame frame = sliding_frame(equilibrium);
      const unsigned int c = frame.points.size(), n_z = frame.across.size(),
                         size = c + n_z + (equilibrium.force_given ? 1 : 0);
      DenseMatrix E(3 * n, size);
      add_block(E, frame.normal, 0, 0);
      add_block(E, forces_along(frame.across, n), 0, c);

      // rows of gap and of V d/dx slip, rows of slip rate
      const auto split = [&](const DenseMatrix &response, DenseMatrix &rows_0, DenseMatrix &rows_1)
      {
        DenseMatrix moved = response;
        convert_to_slip_rows(pair.interface.contacts, scheme, equilibrium.speed, moved);
        rows_0.reinit(size, response.n());
        rows_1.reinit(size, response.n());
        for (unsigned int j = 0; j < response.n(); ++j)
          for (unsigned int k = 0; k < c; ++k)
            rows_0(k, j) = response(frame.points[k], j);
        add_block(rows_0, rows_along(moved, frame.across, n), c, 0);
        add_block(rows_1, rows_along(response, frame.across, n), c, 0);
      };
      ReducedReceptance F;
      const DenseMatrix W = at_once(compliance_of_contact(pair, equilibrium), pair.relaxing);
      split(product(W, E), F.A_0, F.A_1);
      for (const RelaxingRest &rest : pair.relaxing)
      {
        F.rests.push_back({rest.relaxation, DenseMatrix(), DenseMatrix()});
        split(product(rest.flexibility, E), F.rests.back().A_0, F.rests.back().A_1);
      }
      const PatchShapes shapes = patch_shapes(pair.trace, shape_tolerance);
      F.S = shapes.amplitudes;
      split(shapes.basis, F.L_0, F.L_1);
      F.P.reinit(shapes.rank(), size);
      if (shapes.rank() > 0)
        shapes.basis.Tmmult(F.P, E);
      for (unsigned int k = 0; k < n_z; ++k)
        F.A_0(c + k, c + k) += frame.mobility[k];
      const std::vector<double> hub = gaps_by_approach(pair, frame.points);
      if (equilibrium.force_given)
        for (unsigned int k = 0; k < c; ++k)
          F.A_0(k, size - 1) = F.A_0(size - 1, k) = hub[k];
      // slips of what follows forces at once grow as s, gaps that only relax fall as 1 / s
      F.power = pair.relaxing.empty() ? n_z : followed_at_once(W, frame.across, n).size();
      int n_relaxing = 0;
      for (const unsigned int i : frame.points)
        n_relaxing += !pair.relaxing.empty() && W(i, i) == 0;
      F.power -= n_relaxing - (equilibrium.force_given && n_relaxing > 0);
      return F;
    }

    /// arg det F(i w) - power arg(i w + a), between -pi and pi
    double argument(const ReducedReceptance &F, const ContactPair &pair, const double w, const double a)
    {
      const unsigned int size = F.A_0.m(), rank = F.S.m(), m = F.S.n();
      // K = S diag(d) S^T, then K P: real and imaginary parts
      DenseMatrix scaled[2], K(rank, rank), KP[2];
      for (DenseMatrix &part : scaled)
        part.reinit(rank, m);
      for (unsigned int k = 0; k < m; ++k)
      {
        const Complex d = 1. / Complex(pair.omega[k] * pair.omega[k] - w * w,
                                       2 * pair.damping_ratio[k] * pair.omega[k] * w);
        for (unsigned int i = 0; i < rank; ++i)
        {
          scaled[0](i, k) = F.S(i, k) * d.real();
          scaled[1](i, k) = F.S(i, k) * d.imag();
        }
      }
      for (unsigned int part = 0; part < 2; ++part)
      {
        if (rank > 0)
          scaled[part].mTmult(K, F.S);
        KP[part] = product(K, F.P);
      }
      const DenseMatrix Z[4] = {product(F.L_0, KP[0]), product(F.L_0, KP[1]), product(F.L_1, KP[0]),
                                product(F.L_1, KP[1])};
      std::vector<Complex> matrix(std::size_t(size) * size);
      std::vector<double> largest(size, 0.);
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < size; ++i)
        {
          Complex value = Complex(F.A_0(i, j) + Z[0](i, j) - w * Z[3](i, j),
                                  w * F.A_1(i, j) + Z[1](i, j) + w * Z[2](i, j));
          for (const ReducedReceptance::Rest &rest : F.rests)
            value += Complex(rest.A_0(i, j), w * rest.A_1(i, j)) / Complex(1, w * rest.relaxation);
          matrix[std::size_t(j) * size + i] = value;
          largest[i] = std::max(largest[i], std::abs(value));
        }
      const auto refuse = [&]
      {
        throw ConvergenceError("The count of unstable roots met a singular contact at " +
                               number_text(w / (2 * dealii::numbers::PI)) + " Hz: a root lies on the axis.");
      };
      // points that stick without rolling do not resist at 0 Hz
      if (!std::all_of(largest.begin(), largest.end(), [](const double value) { return value > 0; }))
        refuse();
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < size; ++i)
          matrix[std::size_t(j) * size + i] /= largest[i];
      const dealii::types::blas_int order = size;
      std::vector<dealii::types::blas_int> pivots(size);
      dealii::types::blas_int info = 0;
      dealii::getrf(&order, &order, matrix.data(), &order, pivots.data(), &info);
      if (info != 0)
        refuse();
      double sum = -double(F.power) * std::arg(Complex(a, w));
      for (unsigned int k = 0; k < size; ++k)
        sum += std::arg(matrix[std::size_t(k) * size + k]) +
               (pivots[k] != dealii::types::blas_int(k + 1) ? dealii::numbers::PI : 0.);
      return std::remainder(sum, 2 * dealii::numbers::PI);
    }

    /// Frequencies round each free mode and each expected root from half its damping on, twice as far each
    /// time, and a coarse net over everything [rad/s]
    std::vector<double> frequencies(const ContactPair &pair, const std::vector<StabilityRoot> &expected)
    {
      std::vector<double> result = {0.};
      for (double w = 1; w < 1e11; w *= 1.15)
        result.push_back(w);
      const auto add_round = [&](const double w, const double width)
      {
        result.push_back(w);
        for (double distance = width / 2; distance < 0.1 * w; distance *= 2)
        {
          result.push_back(w - distance);
          result.push_back(w + distance);
        }
      };
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        add_round(pair.omega[k], pair.damping_ratio[k] * pair.omega[k]);
      for (const StabilityRoot &root : expected)
      {
        const double w = 2 * dealii::numbers::PI * root.frequency;
        bool at_a_mode = false;
        for (unsigned int k = 0; k < pair.n_modes(); ++k)
          at_a_mode = at_a_mode || std::abs(w - pair.omega[k]) < pair.damping_ratio[k] * pair.omega[k];
        if (!at_a_mode)
          add_round(w, std::max(std::abs(root.growth), 1e-8 * w));
      }
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end(),
                               [](const double a, const double b) { return b - a < 1e-9 * b; }),
                   result.end());
      return result;
    }
  } // namespace

  RootCount count_unstable_roots(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium,
                                 const std::vector<StabilityRoot> &expected)
  {
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      if (!(pair.damping_ratio[k] > 0) || !(pair.omega[k] > 0))
        throw InputError("Stability/Second count needs modes with damping, but " + pair.labels[k] +
                         " has none: give the body a loss factor, or set it to false.");
    constexpr double longest_turn = 0.5, a = 1e4;
    const auto begin = std::chrono::steady_clock::now();
    RootCount result;
    const ReducedReceptance F = receptance(pair, scheme, equilibrium);
    const auto evaluate = [&](const double w)
    {
      ++result.evaluations;
      return argument(F, pair, w, a);
    };
    // the turn from one frequency to another, halved until it is short
    const std::function<double(double, double, double, double, unsigned int)> turn =
        [&](const double w_0, const double arg_0, const double w_1, const double arg_1,
            const unsigned int depth)
    {
      const double step = std::remainder(arg_1 - arg_0, 2 * dealii::numbers::PI);
      if (std::abs(step) < longest_turn || depth == 0)
        return step;
      const double w = (w_0 + w_1) / 2, arg = evaluate(w);
      return turn(w_0, arg_0, w, arg, depth - 1) + turn(w, arg, w_1, arg_1, depth - 1);
    };
    const std::vector<double> net = frequencies(pair, expected);
    double sum = 0, last = evaluate(net[0]);
    for (unsigned int k = 1; k < net.size(); ++k)
    {
      const double next = evaluate(net[k]);
      sum += turn(net[k - 1], last, net[k], next, 40);
      last = next;
    }
    const double winding = -sum / dealii::numbers::PI;
    result.unstable = std::lround(winding);
    result.remainder = winding - result.unstable;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }
} // namespace vibrocontact
