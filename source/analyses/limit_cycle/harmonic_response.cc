#include <vibrocontact/analyses/limit_cycle/harmonic_response.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/contact/point_rows.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// w_n^2 - (k w)^2 + 2 j zeta_n w_n k w, and its derivative by w
    Complex dynamic_stiffness(const ContactPair &pair, const unsigned int mode, const double k,
                              const double omega)
    {
      const double own = pair.omega[mode], forced = k * omega;
      return {own * own - forced * forced, 2 * pair.damping_ratio[mode] * own * forced};
    }
    Complex dynamic_stiffness_slope(const ContactPair &pair, const unsigned int mode, const double k,
                                    const double omega)
    {
      return {-2 * k * k * omega, 2 * pair.damping_ratio[mode] * pair.omega[mode] * k};
    }

    /// The number of an order in a row of columns over the period.
    Complex of_order_in(const DenseMatrix &columns, const unsigned int row, const unsigned int k)
    {
      return k == 0 ? Complex(columns(row, 0)) : Complex(columns(row, 2 * k - 1), columns(row, 2 * k));
    }
    void put_order(const Complex value, const unsigned int row, const unsigned int k, DenseMatrix &columns)
    {
      columns(row, k == 0 ? 0 : 2 * k - 1) = value.real();
      if (k > 0)
        columns(row, 2 * k) = value.imag();
    }

    DenseMatrix times(const std::vector<ComplexMatrix> &by_order, const DenseMatrix &columns)
    {
      DenseMatrix result(by_order.front().m(), columns.n());
      for (unsigned int k = 0; k < by_order.size(); ++k)
        for (unsigned int i = 0; i < result.m(); ++i)
        {
          Complex sum = 0;
          for (unsigned int j = 0; j < columns.m(); ++j)
            sum += by_order[k](i, j) * of_order_in(columns, j, k);
          put_order(sum, i, k, result);
        }
      return result;
    }
  } // namespace

  HarmonicResponse::HarmonicResponse(const ContactPair &pair, const CreepScheme &scheme, const double speed,
                                     const PatchShapes &shapes, const std::vector<unsigned int> &points,
                                     const unsigned int n_harmonics)
      : pair(pair), n_harmonics(n_harmonics),
        moving(on_rows(moving_shapes(pair, scheme, speed, &shapes), rows_of_points(pair.n_points(), points)))
  {
    AssertThrow(std::all_of(pair.omega.begin(), pair.omega.end(), [](const double w) { return w > 0; }),
                dealii::ExcInternalError());
    const std::vector<unsigned int> rows = rows_of_points(pair.n_points(), points);
    rest = tangential_rest = entries_at(pair.residual, rows, rows);
    for (unsigned int j = 0; j < tangential_rest.n(); ++j)
      std::fill_n(&tangential_rest(0, j), points.size(), 0.);
    DenseMatrix moved_rest = pair.residual;
    convert_to_slip_rows(pair.interface.contacts, scheme, speed, moved_rest);
    if (pair.residual_gradient.m() > 0)
      moved_rest.add(speed, pair.residual_gradient);
    by_rest = entries_at(moved_rest, rows, rows);
  }

  void HarmonicResponse::set_frequency(const double new_omega)
  {
    omega = new_omega;
    const unsigned int rank = moving.rank(), n_modes = pair.n_modes(), n_poles = pair.n_poles(),
                       n_columns = n_modes + 2 * n_poles, n_loaded = moving.n_loaded;
    for (std::vector<ComplexMatrix> *const list :
         {&receptance, &receptance_slope, &mobility, &mobility_slope})
      list->assign(n_harmonics + 1, ComplexMatrix(rank, n_loaded));
    // modes, poles, and their conjugates
    ComplexMatrix to(rank, n_columns), from(n_loaded, n_columns);
    std::vector<Complex> inverse(n_columns), slope(n_columns);
    for (unsigned int n = 0; n < n_modes; ++n)
      for (unsigned int i = 0; i < rank; ++i)
        to(i, n) = moving.shapes.amplitudes(i, n);
    for (unsigned int p = 0; p < n_poles; ++p)
      for (unsigned int i = 0; i < rank; ++i)
      {
        to(i, n_modes + p) = moving.right(i, p);
        to(i, n_modes + n_poles + p) = std::conj(moving.right(i, p));
      }
    for (unsigned int i = 0; i < n_loaded; ++i)
    {
      for (unsigned int n = 0; n < n_modes; ++n)
        from(i, n) = moving.shapes.amplitudes(i, n);
      for (unsigned int p = 0; p < n_poles; ++p)
      {
        from(i, n_modes + p) = moving.left(i, p);
        from(i, n_modes + n_poles + p) = std::conj(moving.left(i, p));
      }
    }
    const auto sum = [&](const std::vector<Complex> &weights, ComplexMatrix &result)
    {
      ComplexMatrix weighted = to;
      for (unsigned int j = 0; j < n_columns; ++j)
        for (unsigned int i = 0; i < rank; ++i)
          weighted(i, j) *= weights[j];
      weighted.mTmult(result, from);
    };
    for (unsigned int k = 0; k <= n_harmonics; ++k)
    {
      const Complex rate(0, k * omega), rate_slope(0, k);
      for (unsigned int n = 0; n < n_modes; ++n)
      {
        inverse[n] = 1. / dynamic_stiffness(pair, n, k, omega);
        slope[n] = -inverse[n] * inverse[n] * dynamic_stiffness_slope(pair, n, k, omega);
      }
      for (unsigned int p = 0; p < 2 * n_poles; ++p)
      {
        const Complex pole = p < n_poles ? pair.poles[p] : std::conj(pair.poles[p - n_poles]);
        inverse[n_modes + p] = 1. / (rate - pole);
        slope[n_modes + p] = -rate_slope * inverse[n_modes + p] * inverse[n_modes + p];
      }
      sum(inverse, receptance[k]);
      sum(slope, receptance_slope[k]);
      for (unsigned int j = 0; j < n_loaded; ++j)
        for (unsigned int i = 0; i < rank; ++i)
        {
          mobility[k](i, j) = rate * receptance[k](i, j);
          mobility_slope[k](i, j) = rate_slope * receptance[k](i, j) + rate * receptance_slope[k](i, j);
        }
    }
  }

  /// columns <- factor j k times their order k
  static void multiply_by_order(const double factor, DenseMatrix &columns)
  {
    for (unsigned int k = 0; 2 * k < columns.n(); ++k)
      for (unsigned int i = 0; i < columns.m(); ++i)
        put_order(Complex(0, factor * k) * of_order_in(columns, i, k), i, k, columns);
  }

  void HarmonicResponse::differentiate(DenseMatrix &columns) const
  {
    multiply_by_order(omega, columns);
  }

  DenseMatrix HarmonicResponse::on_loaded_shapes(const DenseMatrix &forces) const
  {
    DenseMatrix result(moving.n_loaded, forces.n());
    top_left(moving.shapes.basis, n_rows(), moving.n_loaded).Tmmult(result, forces);
    return result;
  }

  DenseMatrix HarmonicResponse::along(const DenseMatrix &forces,
                                      const std::vector<ComplexMatrix> &displacement,
                                      const std::vector<ComplexMatrix> &velocity, const double rate) const
  {
    DenseMatrix y(forces.m(), forces.n()), rates = forces;
    const DenseMatrix on_shapes = on_loaded_shapes(forces);
    moving.by_displacement.mmult(y, times(displacement, on_shapes));
    moving.by_velocity.mmult(y, times(velocity, on_shapes), true);
    multiply_by_order(rate, rates);
    tangential_rest.mmult(y, rates, true);
    return y;
  }

  DenseMatrix HarmonicResponse::response(const DenseMatrix &forces) const
  {
    DenseMatrix y = along(forces, receptance, mobility, omega);
    by_rest.mmult(y, forces, true);
    return y;
  }

  DenseMatrix HarmonicResponse::response_slope(const DenseMatrix &forces) const
  {
    return along(forces, receptance_slope, mobility_slope, 1);
  }

  DenseMatrix HarmonicResponse::rate_of_rest(const DenseMatrix &forces) const
  {
    DenseMatrix y = product(tangential_rest, forces);
    multiply_by_order(omega, y);
    return y;
  }

  DenseMatrix HarmonicResponse::rate_of_rest_slope(const DenseMatrix &forces) const
  {
    DenseMatrix y = product(tangential_rest, forces);
    multiply_by_order(1, y);
    return y;
  }

  ComplexMatrix HarmonicResponse::of_order(const unsigned int k) const
  {
    ComplexMatrix left = product(entries_as<Complex>(moving.by_displacement), receptance[k]);
    left.add(1., product(entries_as<Complex>(moving.by_velocity), mobility[k]));
    ComplexMatrix y(n_rows());
    left.mTmult(y, entries_as<Complex>(top_left(moving.shapes.basis, n_rows(), moving.n_loaded)));
    y.add(1., entries_as<Complex>(by_rest));
    y.add(1., rate_of_rest_of_order(k));
    return y;
  }

  ComplexMatrix HarmonicResponse::rate_of_rest_of_order(const unsigned int k) const
  {
    // deal.II multiplies complex matrices by real numbers alone
    ComplexMatrix y(n_rows());
    for (unsigned int j = 0; j < n_rows(); ++j)
      for (unsigned int i = 0; i < n_rows(); ++i)
        y(i, j) = Complex(0, k * omega * tangential_rest(i, j));
    return y;
  }

  std::vector<double> HarmonicResponse::own_compliance() const
  {
    const double highest = n_harmonics * omega;
    std::vector<double> result;
    for (unsigned int i = 0; i < n_rows(); ++i)
    {
      double compliance = std::abs(rest(i, i));
      for (unsigned int n = 0; n < pair.n_modes(); ++n)
      {
        double shape = 0;
        for (unsigned int k = 0; k < moving.rank(); ++k)
          shape += moving.shapes.basis(i, k) * moving.shapes.amplitudes(k, n);
        compliance += std::pow(shape / std::max(pair.omega[n], highest), 2);
      }
      for (unsigned int p = 0; p < pair.n_poles(); ++p)
      {
        Complex to = 0, from = 0;
        for (unsigned int k = 0; k < moving.rank(); ++k)
        {
          to += moving.shapes.basis(i, k) * moving.right(k, p);
          from += moving.shapes.basis(i, k) * moving.left(k, p);
        }
        const double frequency = std::abs(pair.poles[p]);
        compliance += 2 * frequency * std::abs(to * from) / std::pow(std::max(frequency, highest), 2);
      }
      const bool is_normal = 3 * i < n_rows();
      result.push_back(is_normal ? compliance : highest * compliance + std::abs(by_rest(i, i)));
    }
    return result;
  }

  DenseMatrix HarmonicResponse::modal_amplitudes(const DenseMatrix &forces) const
  {
    DenseMatrix q(pair.n_modes(), forces.n());
    if (q.m() > 0)
      top_left(moving.shapes.amplitudes, moving.n_loaded, q.m()).Tmmult(q, on_loaded_shapes(forces));
    for (unsigned int k = 0; k <= n_harmonics; ++k)
      for (unsigned int n = 0; n < q.m(); ++n)
        put_order(of_order_in(q, n, k) / dynamic_stiffness(pair, n, k, omega), n, k, q);
    return q;
  }

  DenseMatrix HarmonicResponse::pole_states(const DenseMatrix &forces) const
  {
    const unsigned int n = pair.n_poles();
    DenseMatrix states(2 * n, forces.n());
    const DenseMatrix on_shapes = on_loaded_shapes(forces);
    for (unsigned int k = 0; k <= n_harmonics; ++k)
      for (unsigned int p = 0; p < n; ++p)
      {
        // what the forces of order k and of order -k feed into the state, which is no real function
        Complex feed = 0, feed_back = 0;
        for (unsigned int i = 0; i < moving.n_loaded; ++i)
        {
          const Complex force = of_order_in(on_shapes, i, k);
          feed += moving.left(i, p) * force;
          feed_back += moving.left(i, p) * std::conj(force);
        }
        const Complex forth = feed / (Complex(0, k * omega) - pair.poles[p]),
                      back = std::conj(feed_back / (Complex(0, -(k * omega)) - pair.poles[p]));
        put_order(k == 0 ? Complex(forth.real()) : (forth + back) / 2., p, k, states);
        put_order(k == 0 ? Complex(forth.imag()) : (forth - back) / Complex(0, 2), n + p, k, states);
      }
    return states;
  }
} // namespace vibrocontact
