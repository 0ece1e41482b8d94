#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/coupled_bodies/moving_shapes.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// The columns of both shapes of the poles behind those of the modes, as large as the largest of these.
    DenseMatrix all_shapes(const BodyInContact &body)
    {
      const unsigned int n = body.n_rows(), m = body.n_modes();
      if (body.n_poles() == 0)
        return body.trace;
      DenseMatrix result(n, m + 4 * body.n_poles());
      double largest = 0;
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int i = 0; i < n; ++i)
          largest = std::max(largest, std::abs(result(i, k) = body.trace(i, k)));
      unsigned int column = m;
      for (const ComplexMatrix *const shapes : {&body.right, &body.left})
        for (unsigned int k = 0; k < body.n_poles(); ++k, column += 2)
        {
          double own = 0;
          for (unsigned int i = 0; i < n; ++i)
            own = std::max(own, std::abs((*shapes)(i, k)));
          const double scale = own > 0 ? (largest > 0 ? largest : 1) / own : 0;
          for (unsigned int i = 0; i < n; ++i)
          {
            result(i, column) = scale * (*shapes)(i, k).real();
            result(i, column + 1) = scale * (*shapes)(i, k).imag();
          }
        }
      return result;
    }

    ComplexMatrix in_terms_of(const DenseMatrix &basis, const ComplexMatrix &shapes)
    {
      ComplexMatrix result(basis.n(), shapes.n());
      for (unsigned int k = 0; k < shapes.n(); ++k)
        for (unsigned int j = 0; j < basis.n(); ++j)
          for (unsigned int i = 0; i < basis.m(); ++i)
            result(j, k) += basis(i, j) * shapes(i, k);
      return result;
    }

    /// Numbers of their own for the gradients of the poles, behind those of the shapes: what moves through them is no
    /// displacement of the points, and no force feeds it.
    void add_gradients(const BodyInContact &body, MovingShapes &moving, const double speed)
    {
      std::vector<unsigned int> along;
      for (unsigned int i = 0; i < body.gradient.m(); ++i)
        for (unsigned int k = 0; k < body.n_poles(); ++k)
          if (body.gradient(i, k) != 0.)
          {
            along.push_back(i);
            break;
          }
      const unsigned int rank = moving.shapes.rank(), n = rank + along.size();
      const auto extended = [n](const auto &matrix, const bool by_columns)
      {
        auto result = matrix;
        result.reinit(by_columns ? matrix.m() : n, by_columns ? n : matrix.n());
        for (unsigned int j = 0; j < matrix.n(); ++j)
          for (unsigned int i = 0; i < matrix.m(); ++i)
            result(i, j) = matrix(i, j);
        return result;
      };
      moving.shapes.basis = extended(moving.shapes.basis, true);
      moving.shapes.amplitudes = extended(moving.shapes.amplitudes, false);
      moving.left = extended(moving.left, false);
      moving.right = extended(moving.right, false);
      moving.by_displacement = extended(moving.by_displacement, true);
      moving.by_velocity = extended(moving.by_velocity, true);
      for (unsigned int j = 0; j < along.size(); ++j)
      {
        moving.by_displacement(along[j], rank + j) = speed;
        for (unsigned int k = 0; k < body.n_poles(); ++k)
          moving.right(rank + j, k) = body.gradient(along[j], k);
      }
    }
  } // namespace

  PatchShapes shapes_of_steps(const ContactPair &pair)
  {
    return patch_shapes(all_shapes(pair), patch_shape_tolerance);
  }

  MovingShapes moving_shapes(const ContactPair &pair, const CreepScheme &scheme, const double speed,
                             const PatchShapes *const known)
  {
    const PlacedContacts &contacts = pair.interface.contacts;
    MovingShapes result;
    result.shapes = known ? *known : shapes_of_steps(pair);
    PatchShapes &shapes = result.shapes;
    result.n_loaded = shapes.rank();
    if (pair.n_poles() > 0)
    {
      result.right = in_terms_of(shapes.basis, pair.right);
      result.left = in_terms_of(shapes.basis, pair.left);
      shapes.amplitudes.reinit(shapes.rank(), pair.n_modes());
      if (pair.n_modes() > 0)
        shapes.basis.Tmmult(shapes.amplitudes, pair.trace);
    }
    result.by_displacement = result.by_velocity = shapes.basis;
    convert_to_slip_rows(contacts, scheme, speed, result.by_displacement);
    for (unsigned int k = 0; k < shapes.rank(); ++k)
      std::fill_n(&result.by_velocity(0, k), contacts.n_points(), 0.);
    if (pair.gradient.m() > 0)
      add_gradients(pair, result, speed);
    return result;
  }

  MovingShapes on_rows(const MovingShapes &all, const std::vector<unsigned int> &rows)
  {
    std::vector<unsigned int> own;
    for (unsigned int k = 0; k < all.rank(); ++k)
      if (std::any_of(rows.begin(), rows.end(),
                      [&](const unsigned int row)
                      { return all.shapes.basis(row, k) != 0 || all.by_displacement(row, k) != 0; }))
        own.push_back(k);
    MovingShapes result;
    result.n_loaded = std::lower_bound(own.begin(), own.end(), all.n_loaded) - own.begin();
    result.shapes.basis = entries_at(all.shapes.basis, rows, own);
    result.shapes.amplitudes = rows_at(all.shapes.amplitudes, own);
    result.by_displacement = entries_at(all.by_displacement, rows, own);
    result.by_velocity = entries_at(all.by_velocity, rows, own);
    result.right = rows_at(all.right, own);
    result.left = rows_at(all.left, own);
    return result;
  }

  DenseMatrix parts_of(const ComplexMatrix &shapes)
  {
    const unsigned int n = shapes.n();
    DenseMatrix result(shapes.m(), 2 * n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < shapes.m(); ++i)
      {
        result(i, k) = 2 * shapes(i, k).real();
        result(i, n + k) = -2 * shapes(i, k).imag();
      }
    return result;
  }
} // namespace vibrocontact
