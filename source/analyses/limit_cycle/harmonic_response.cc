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
      DenseMatrix result(columns.m(), columns.n());
      for (unsigned int k = 0; k < by_order.size(); ++k)
        for (unsigned int i = 0; i < columns.m(); ++i)
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
      : pair(pair), shapes(shapes), n_harmonics(n_harmonics)
  {
    AssertThrow(std::all_of(pair.omega.begin(), pair.omega.end(), [](const double w) { return w > 0; }),
                dealii::ExcInternalError());
    const std::vector<unsigned int> rows = rows_of_points(pair.n_points(), points);
    basis = by_velocity = rows_at(shapes.basis, rows);
    rest = tangential_rest = columns_at(rows_at(pair.residual, rows), rows);
    const auto without_normal_rows = [&](DenseMatrix &matrix)
    {
      for (unsigned int j = 0; j < matrix.n(); ++j)
        std::fill_n(&matrix(0, j), points.size(), 0.);
    };
    without_normal_rows(by_velocity);
    without_normal_rows(tangential_rest);
    DenseMatrix moved = shapes.basis, moved_rest = pair.residual;
    convert_to_slip_rows(pair.interface.contacts, scheme, speed, moved);
    convert_to_slip_rows(pair.interface.contacts, scheme, speed, moved_rest);
    by_displacement = rows_at(moved, rows);
    by_rest = columns_at(rows_at(moved_rest, rows), rows);
  }

  void HarmonicResponse::set_frequency(const double new_omega)
  {
    omega = new_omega;
    const unsigned int rank = shapes.rank(), n_modes = pair.n_modes();
    for (std::vector<ComplexMatrix> *const list :
         {&receptance, &receptance_slope, &mobility, &mobility_slope})
      list->assign(n_harmonics + 1, ComplexMatrix(rank));
    for (unsigned int k = 0; k <= n_harmonics; ++k)
    {
      std::vector<Complex> inverse(n_modes), slope(n_modes);
      for (unsigned int n = 0; n < n_modes; ++n)
      {
        inverse[n] = 1. / dynamic_stiffness(pair, n, k, omega);
        slope[n] = -inverse[n] * inverse[n] * dynamic_stiffness_slope(pair, n, k, omega);
      }
      const Complex rate(0, k * omega), rate_slope(0, k);
      for (unsigned int j = 0; j < rank; ++j)
        for (unsigned int i = 0; i <= j; ++i)
        {
          Complex G = 0, G_slope = 0;
          for (unsigned int n = 0; n < n_modes; ++n)
          {
            const double shape = shapes.amplitudes(i, n) * shapes.amplitudes(j, n);
            G += shape * inverse[n];
            G_slope += shape * slope[n];
          }
          receptance[k](i, j) = receptance[k](j, i) = G;
          receptance_slope[k](i, j) = receptance_slope[k](j, i) = G_slope;
          mobility[k](i, j) = mobility[k](j, i) = rate * G;
          mobility_slope[k](i, j) = mobility_slope[k](j, i) = rate_slope * G + rate * G_slope;
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

  DenseMatrix HarmonicResponse::along(const DenseMatrix &forces,
                                      const std::vector<ComplexMatrix> &displacement,
                                      const std::vector<ComplexMatrix> &velocity, const double rate) const
  {
    DenseMatrix on_shapes(shapes.rank(), forces.n()), y(forces.m(), forces.n()), rates = forces;
    basis.Tmmult(on_shapes, forces);
    by_displacement.mmult(y, times(displacement, on_shapes));
    by_velocity.mmult(y, times(velocity, on_shapes), true);
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
    ComplexMatrix left = product(entries_as<Complex>(by_displacement), receptance[k]);
    left.add(1., product(entries_as<Complex>(by_velocity), mobility[k]));
    ComplexMatrix y(n_rows());
    left.mTmult(y, entries_as<Complex>(basis));
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
        for (unsigned int k = 0; k < shapes.rank(); ++k)
          shape += basis(i, k) * shapes.amplitudes(k, n);
        compliance += std::pow(shape / std::max(pair.omega[n], highest), 2);
      }
      const bool is_normal = 3 * i < n_rows();
      result.push_back(is_normal ? compliance : highest * compliance + std::abs(by_rest(i, i)));
    }
    return result;
  }

  DenseMatrix HarmonicResponse::modal_amplitudes(const DenseMatrix &forces) const
  {
    DenseMatrix on_shapes(shapes.rank(), forces.n()), q(pair.n_modes(), forces.n());
    basis.Tmmult(on_shapes, forces);
    shapes.amplitudes.Tmmult(q, on_shapes);
    for (unsigned int k = 0; k <= n_harmonics; ++k)
      for (unsigned int n = 0; n < q.m(); ++n)
        put_order(of_order_in(q, n, k) / dynamic_stiffness(pair, n, k, omega), n, k, q);
    return q;
  }
} // namespace vibrocontact
