#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/contact/point_rows.h>
#include <vibrocontact/coupled_bodies/moving_shapes.h>
#include <vibrocontact/marching/step_operator.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// fewer than the n-th part of the points: by their columns alone
    constexpr unsigned int few_sources = 8;
    /// of fewer points all matrices are at hand in double precision
    constexpr unsigned int least_points_in_single = 16;

    // amplitudes diag(g1) amplitudes^T - amplitudes damper_gain B diag(g1_v) amplitudes^T
    DenseMatrix gain(const DenseMatrix &amplitudes, const std::vector<ModalStep> &steps,
                     const unsigned int component, const HubDamper &damper)
    {
      const auto scaled = [&](const unsigned int by)
      {
        DenseMatrix x(amplitudes.m(), amplitudes.n());
        for (unsigned int k = 0; k < amplitudes.n(); ++k)
          for (unsigned int i = 0; i < amplitudes.m(); ++i)
            x(i, k) = amplitudes(i, k) * steps[k].g1[by];
        return x;
      };
      DenseMatrix result(amplitudes.m());
      if (amplitudes.m() == 0)
        return result;
      scaled(component).mTmult(result, amplitudes);
      if (!damper.acts())
        return result;
      DenseMatrix moved(amplitudes.m(), damper.motion.m()), taken(amplitudes.m());
      scaled(1).mTmult(moved, damper.motion);
      product(amplitudes, component == 0 ? damper.displacement : damper.velocity).mTmult(taken, moved);
      result.add(-1., taken);
      return result;
    }

    /// Columns of padded length, one behind the other.
    AlignedSingleVector single_precision_columns(const DenseMatrix &matrix)
    {
      const std::size_t stride = padded_single(matrix.m());
      AlignedSingleVector result(stride * matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          result[stride * j + i] = static_cast<float>(matrix(i, j));
      return result;
    }

    // into += left middle right^T
    void add_product(const DenseMatrix &left, const DenseMatrix &middle, const DenseMatrix &right,
                     DenseMatrix &into)
    {
      if (middle.m() == 0)
        return;
      product(left, middle).mTmult(into, right, true);
    }
  } // namespace

  StepMatrices step_matrices(const CreepScheme &scheme, const ContactPair &body,
                             const std::vector<ModalStep> &steps, const double h, const double speed,
                             const SuspendedHub *const hub, const StepWeights &pole_steps,
                             const PatchShapes *const known, const double residual_theta)
  {
    const PlacedContacts &contacts = body.interface.contacts;
    const unsigned int n = contacts.n_points();
    StepMatrices result;
    result.contacts = contacts;
    result.scheme = scheme;
    result.step = h;
    result.residual_theta = residual_theta;
    result.speed = speed;
    if (body.half_spaces)
    {
      std::vector<double> upstream = scheme.convection(speed, contacts.only().spacing_x);
      upstream[0] += 1 / result.rate_step();
      result.half_spaces = body.half_spaces;
      result.half_space_response =
          std::make_shared<HalfSpaceOperator>(contacts.only(), body.half_spaces->pair, upstream);
      return result;
    }
    result.residual_flexibility = result.response = rest_over_step(body, h);
    static_cast<MovingShapes &>(result) = moving_shapes(body, scheme, speed, known);
    const PatchShapes &shapes = result.shapes;
    const ComplexMatrix &right = result.right, &left = result.left;
    result.residual_gradient = body.residual_gradient;
    const HubDamper damper(hub, steps);
    result.displacement_gain = gain(shapes.amplitudes, steps, 0, damper);
    result.velocity_gain = gain(shapes.amplitudes, steps, 1, damper);
    if (body.n_modes() == 0)
    {
      result.displacement_gain.reinit(shapes.rank());
      result.velocity_gain.reinit(shapes.rank());
    }
    for (unsigned int k = 0; k < body.n_poles(); ++k)
      for (unsigned int j = 0; j < shapes.rank(); ++j)
      {
        const std::complex<double> to = 2. * left(j, k);
        for (unsigned int i = 0; i < shapes.rank(); ++i)
        {
          const std::complex<double> residue = right(i, k) * to;
          result.displacement_gain(i, j) += (residue * pole_steps.now[k]).real();
          result.velocity_gain(i, j) += (residue * (body.poles[k] * pole_steps.now[k] + 1.)).real();
        }
      }

    result.by_poles = parts_of(right);
    result.into_poles = parts_of(left);

    DenseMatrix &A = result.response;
    convert_to_slip_rows(contacts, scheme, speed, A);
    for (unsigned int j = 0; j < 3 * n; ++j)
      for (unsigned int i = n; i < 3 * n; ++i)
        A(i, j) += result.residual_flexibility(i, j) / result.rate_step();
    if (result.residual_gradient.m() > 0)
      A.add(speed, result.residual_gradient);
    add_product(result.by_displacement, result.displacement_gain, shapes.basis, A);
    add_product(result.by_velocity, result.velocity_gain, shapes.basis, A);
    return result;
  }

  StepOperator::StepOperator(const StepMatrices &matrices, std::vector<unsigned int> points)
      : matrices(matrices), nearby(std::move(points)),
        basis(rows_at(matrices.shapes.basis, rows_of_points(matrices.contacts.n_points(), nearby))),
        by_motion(3 * nearby.size(), 2 * basis.n()), c_normal(basis.n()), c_tangential(basis.n()),
        displacement(basis.n()), velocity(basis.n())
  {
    for (unsigned int part = 0; part < 2; ++part)
    {
      const DenseMatrix rows = rows_at(part == 0 ? matrices.by_displacement : matrices.by_velocity,
                                       rows_of_points(matrices.contacts.n_points(), nearby));
      for (unsigned int k = 0; k < basis.n(); ++k)
        std::copy_n(&rows(0, k), rows.m(), &by_motion(0, part * basis.n() + k));
    }
    const PlacedContacts &contacts = matrices.contacts;
    const unsigned int n = contacts.n_points();
    const auto contact_of = [&](const unsigned int point) -> const PlacedContact &
    { return contacts.all[contacts.contact_of(point)]; };
    const auto column_of = [&](const unsigned int point)
    { return (point - contacts.first_point(contacts.contact_of(point))) % contact_of(point).grid.n_x; };
    const auto coefficients = [&](const unsigned int point) -> const std::vector<double> &
    { return matrices.scheme.at_column(column_of(point)); };
    for (unsigned int point = 0; point < n; ++point)
      if (!std::binary_search(nearby.begin(), nearby.end(), point))
        others.push_back(point);
    std::vector<unsigned int> wet;
    for (const unsigned int point : nearby)
    {
      for (unsigned int k = 0; k < coefficients(point).size(); ++k)
        wet.push_back(point - k);
      if (column_of(point) + 1 < contact_of(point).grid.n_x)
        wet.push_back(point + 1);
    }
    std::sort(wet.begin(), wet.end());
    wet.erase(std::unique(wet.begin(), wet.end()), wet.end());
    n_wet = wet.size();
    for (const unsigned int point : nearby)
    {
      const std::vector<double> &c = coefficients(point);
      const PlacedContact &contact = contact_of(point);
      const double speed_in_spacings = matrices.speed * contact.share_of_speed() / contact.grid.spacing_x;
      transport.emplace_back();
      for (unsigned int k = 0; k < c.size(); ++k)
        transport.back().emplace_back(std::lower_bound(wet.begin(), wet.end(), point - k) - wet.begin(),
                                      speed_in_spacings * c[k] + (k == 0 ? 1 / matrices.rate_step() : 0));
    }

    rows = nearby;
    for (unsigned int c = 1; c < 3; ++c)
      for (const unsigned int point : wet)
        rows.push_back(contact_row(n, c, point));
    residual.reinit(rows.size());
    if (!matrices.half_spaces)
    {
      residual_columns = columns_at_points(matrices.residual_flexibility, rows);
      if (has_gradient())
      {
        gradient_columns = columns_at_points(matrices.residual_gradient, rows_of_points(n, nearby));
        gradient_columns *= matrices.speed;
      }
      for (unsigned int c = 0; c < 3; ++c)
        for (const unsigned int point : nearby)
          diagonals.push_back(matrices.response(contact_row(n, c, point), contact_row(n, c, point)));
    }
    // of the whole grid: rho does not move with the points that are nearby
    for (unsigned int c = 0; c < 3; ++c)
    {
      mean[c] = matrices.half_spaces ? matrices.half_space_response->mean_diagonal(c) : 0;
      for (unsigned int i = 0; i < n && !matrices.half_spaces; ++i)
        mean[c] += matrices.response(contact_row(n, c, i), contact_row(n, c, i)) / n;
    }
  }

  std::vector<unsigned int> StepOperator::on_grid(const std::vector<unsigned int> &points) const
  {
    std::vector<unsigned int> result;
    for (const unsigned int point : points)
      result.push_back(nearby[point]);
    return result;
  }

  void StepOperator::respond_by_kernels(const DenseVector &R, const std::vector<unsigned int> &sources,
                                        const std::vector<unsigned int> &of_rows,
                                        DenseVector &displacement) const
  {
    const unsigned int m = n_points(), n = matrices.contacts.n_points();
    DenseVector on_all(3 * n), displacement_of_all;
    for (unsigned int c = 0; c < 3; ++c)
      for (const unsigned int j : sources)
        on_all[contact_row(n, c, nearby[j])] = R[contact_row(m, c, j)];
    matrices.half_spaces->flexibility.vmult(displacement_of_all, on_all, on_grid(sources));
    for (unsigned int i = 0; i < of_rows.size(); ++i)
      displacement[i] = displacement_of_all[of_rows[i]];
  }

  void StepOperator::residual_gaps_of_others(const DenseVector &R, DenseVector &gaps) const
  {
    gaps.reinit(others.size());
    if (others.empty())
      return;
    // a point's normal row has its own number
    if (matrices.half_spaces)
      return respond_by_kernels(R, loaded_points(R, n_points()), others, gaps);
    if (columns_of_others.m() == 0)
      columns_of_others = columns_at_points(matrices.residual_flexibility, others);
    columns_of_others.vmult(gaps, R);
  }

  void StepOperator::take_single_precision() const
  {
    single_columns = single_precision_columns(residual_columns);
    single_rows.resize(padded_single(residual_columns.m()));
    if (basis.n() == 0)
      return;
    DenseMatrix gains(2 * basis.n(), basis.n()), transposed(basis.n(), basis.m());
    add_block(gains, matrices.displacement_gain, 0, 0);
    add_block(gains, matrices.velocity_gain, basis.n(), 0);
    basis.transpose(transposed);
    single_basis = single_precision_columns(transposed);
    single_motion = single_precision_columns(product(by_motion, gains));
    single_numbers.resize(padded_single(basis.n()));
    single_moved.resize(padded_single(by_motion.m()));
  }

  DenseMatrix StepOperator::columns_at_points(const DenseMatrix &matrix,
                                              const std::vector<unsigned int> &of_rows) const
  {
    return entries_at(matrix, of_rows, rows_of_points(matrices.contacts.n_points(), nearby));
  }

  void StepOperator::multiply_columns(const DenseMatrix &columns, const DenseVector &R,
                                      const std::vector<unsigned int> &sources, DenseVector &y) const
  {
    const unsigned int m = n_points();
    if (sources.size() * few_sources > m)
      return columns.vmult(y, R);
    y = 0;
    for (unsigned int c = 0; c < 3; ++c)
      for (const unsigned int source : sources)
      {
        const unsigned int column = contact_row(m, c, source);
        for (unsigned int i = 0; i < y.size(); ++i)
          y[i] += columns(i, column) * R[column];
      }
  }

  void StepOperator::vmult(DenseVector &y, const DenseVector &R,
                           const std::vector<unsigned int> &sources) const
  {
    const unsigned int m = n_points();
    y.reinit(3 * m + rows.size());
    if (sources.empty())
      return;
    if (matrices.half_spaces)
      respond_by_kernels(R, sources, rows, residual);
    else
      multiply_columns(residual_columns, R, sources, residual);
    std::copy(residual.begin(), residual.end(), y.begin() + 3 * m);

    modal_numbers(R, c_normal, c_tangential);
    c_normal += c_tangential;
    multiply(matrices.displacement_gain, c_normal, displacement);
    multiply(matrices.velocity_gain, c_normal, velocity);
    respond({{displacement, velocity}}, {&y});
    if (!has_gradient())
      return;
    along_path.reinit(3 * m);
    multiply_columns(gradient_columns, R, sources, along_path);
    for (unsigned int i = 0; i < 3 * m; ++i)
      y[i] += along_path[i];
  }

  bool StepOperator::changes_in_single_precision() const
  {
    return n_points() >= least_points_in_single && !matrices.half_spaces && !has_gradient();
  }

  void StepOperator::vmult_change(DenseVector &y, const DenseVector &change,
                                  const std::vector<unsigned int> &sources) const
  {
    if (sources.empty() || !changes_in_single_precision())
      return vmult(y, change, sources);
    if (single_columns.empty())
      take_single_precision();
    const unsigned int m = n_points();
    single_listed.clear();
    single_forces.clear();
    for (unsigned int c = 0; c < 3; ++c)
      for (const unsigned int source : sources)
      {
        single_listed.push_back(contact_row(m, c, source));
        single_forces.push_back(static_cast<float>(change[single_listed.back()]));
      }
    const auto add_listed = [&](const AlignedSingleVector &columns, AlignedSingleVector &sum)
    {
      std::fill(sum.begin(), sum.end(), 0.F);
      wide_add_columns(sum.data(), columns.data(), sum.size(), single_listed.data(), single_forces.data(),
                       single_listed.size());
    };
    y.reinit(3 * m + rows.size(), true);
    add_listed(single_columns, single_rows);
    std::copy_n(single_rows.begin(), rows.size(), y.begin() + 3 * m);
    transport_residual(y.data() + 3 * m, y.data());
    if (basis.n() == 0)
      return;
    add_listed(single_basis, single_numbers);
    std::fill(single_moved.begin(), single_moved.end(), 0.F);
    wide_add_columns(single_moved.data(), single_motion.data(), single_moved.size(), nullptr,
                     single_numbers.data(), basis.n());
    for (unsigned int i = 0; i < 3 * m; ++i)
      y[i] += single_moved[i];
  }

  void StepOperator::transport_residual(const double *const w, double *const y) const
  {
    const unsigned int m = n_points();
    std::copy_n(w, m, y);
    for (unsigned int c = 1; c < 3; ++c)
    {
      const double *const tangential = w + m + (c - 1) * n_wet;
      for (unsigned int i = 0; i < m; ++i)
      {
        double sum = 0;
        for (const auto &[place, factor] : transport[i])
          sum += factor * tangential[place];
        y[contact_row(m, c, i)] = sum;
      }
    }
  }

  void StepOperator::respond(const std::vector<MotionOfShapes> &motions,
                             const std::vector<DenseVector *> &y) const
  {
    AssertDimension(motions.size(), y.size());
    moved.resize(std::max(moved.size(), motions.size()), DenseVector(2 * basis.n()));
    std::vector<const DenseVector *> factors;
    for (std::size_t k = 0; k < motions.size(); ++k)
    {
      const auto &[displacement_of_shapes, velocity_of_shapes] = motions[k];
      std::copy(displacement_of_shapes.begin(), displacement_of_shapes.end(), moved[k].begin());
      std::copy(velocity_of_shapes.begin(), velocity_of_shapes.end(), moved[k].begin() + basis.n());
      factors.push_back(&moved[k]);
      transport_residual(y[k]->data() + 3 * n_points(), y[k]->data());
    }
    add_products(by_motion, factors, y);
  }

  void StepOperator::modal_numbers(const DenseVector &R, DenseVector &c_n, DenseVector &c_t) const
  {
    const dealii::types::blas_int m = n_points(), twice = 2 * m, n_rows = 3 * m, n_columns = basis.n(),
                                  one = 1;
    if (n_columns == 0)
      return;
    const double unit = 1, zero = 0;
    dealii::gemv("T", &m, &n_columns, &unit, &basis(0, 0), &n_rows, R.data(), &one, &zero, c_n.data(), &one);
    dealii::gemv("T", &twice, &n_columns, &unit, &basis(m, 0), &n_rows, R.data() + m, &one, &zero, c_t.data(),
                 &one);
  }

  void StepOperator::extract(const std::vector<unsigned int> &points, DenseMatrix &block) const
  {
    if (matrices.half_spaces)
      return matrices.half_space_response->extract(on_grid(points), block);
    const unsigned int n = matrices.contacts.n_points(), m = points.size();
    block.reinit(3 * m);
    for (unsigned int component = 0; component < 3; ++component)
      for (unsigned int j = 0; j < m; ++j)
      {
        const double *const from = &matrices.response(0, contact_row(n, component, nearby[points[j]]));
        double *const to = &block(0, contact_row(m, component, j));
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < m; ++i)
            to[contact_row(m, c, i)] = from[contact_row(n, c, nearby[points[i]])];
      }
  }
} // namespace vibrocontact
