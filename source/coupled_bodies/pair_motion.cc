#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>

namespace vibrocontact
{
  DenseMatrix span_of_forces(const SlidingFrame &frame, const unsigned int n)
  {
    const DenseMatrix across = forces_along(frame.across, n), along = forces_along(frame.along, n);
    DenseMatrix result(3 * n, frame.normal.n() + across.n() + along.n());
    add_block(result, frame.normal, 0, 0);
    add_block(result, across, 0, frame.normal.n());
    add_block(result, along, 0, frame.normal.n() + across.n());
    return result;
  }

  DenseMatrix shares_in(const DenseMatrix &forces)
  {
    DenseMatrix shares(forces.n(), forces.m());
    for (unsigned int j = 0; j < forces.n(); ++j)
      for (unsigned int i = 0; i < forces.m(); ++i)
        shares(j, i) = forces(i, j);
    DenseMatrix square = product(shares, forces);
    if (square.m() == 0)
      return shares;
    square.compute_lu_factorization();
    square.solve(shares);
    return shares;
  }

  namespace
  {
    /// Rests that relax, s' = (R - s) / beta.
    void add_rests(const ContactPair &pair, const std::vector<RelaxingRest> &rests, const DenseMatrix &forces,
                   PairMotion &motion)
    {
      const unsigned int n_rows = forces.m(), n_forces = forces.n(), m = pair.n_modes();
      const DenseMatrix shares = shares_in(forces);
      motion.rest_rate.reinit(n_rows, motion.transition.m());
      motion.rest_rate_at_once.reinit(n_rows, n_rows);
      unsigned int first = 2 * (m + pair.n_poles());
      for (const RelaxingRest &rest : rests)
      {
        const double rate = 1 / rest.relaxation;
        for (unsigned int j = 0; j < n_forces; ++j)
          motion.transition(first + j, first + j) = -rate;
        add_block(motion.input, shares, first - m, 0, rate);
        const DenseMatrix moved = product(rest.flexibility, forces);
        add_block(motion.displacement, moved, 0, first);
        add_block(motion.rest_rate, moved, 0, first, -rate);
        motion.rest_rate_at_once.add(rate, rest.flexibility);
        first += n_forces;
      }
    }
  } // namespace

  PairMotion pair_motion(const ContactPair &pair, const std::vector<RelaxingRest> &rests,
                         const DenseMatrix &forces)
  {
    const unsigned int n_rows = 3 * pair.n_points(), m = pair.n_modes(), p = pair.n_poles(),
                       size = 2 * (m + p) + rests.size() * forces.n();
    PairMotion motion;
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
    if (pair.hub && pair.hub->is_damped())
      for (unsigned int j = 0; j < pair.hub->shapes.n(); ++j)
        for (unsigned int k = 0; k < pair.hub->shapes.n(); ++k)
          motion.transition(m + k, m + j) -= pair.hub->modal_damping(k, j);
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
    if (!rests.empty() && forces.n() > 0)
      add_rests(pair, rests, forces, motion);
    return motion;
  }

  DenseMatrix at_once(const DenseMatrix &W, const std::vector<RelaxingRest> &rests)
  {
    DenseMatrix result = W;
    for (const RelaxingRest &rest : rests)
      result.add(-1., rest.flexibility);
    for (unsigned int i = 0; i < W.m() && !rests.empty(); ++i)
      if (result(i, i) <= 1e-12 * W(i, i))
        for (unsigned int j = 0; j < W.m(); ++j)
          result(i, j) = result(j, i) = 0;
    return result;
  }

  std::vector<unsigned int> followed_at_once(const DenseMatrix &W,
                                             const std::vector<ContactDirection> &directions,
                                             const unsigned int n)
  {
    const DenseMatrix moved = rows_along(W, directions, n);
    std::vector<unsigned int> places;
    for (unsigned int k = 0; k < directions.size(); ++k)
    {
      const ContactDirection &d = directions[k];
      if (d.x * moved(k, n + d.point) + d.y * moved(k, 2 * n + d.point) > 0)
        places.push_back(k);
    }
    return places;
  }
} // namespace vibrocontact
