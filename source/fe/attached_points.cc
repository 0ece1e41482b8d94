#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/fe/group_motion.h>

#include <deal.II/base/tensor.h>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Matrix3 = Tensor<2, 3>;

    /// a x
    Matrix3 cross_matrix(const Tensor<1, 3> &a)
    {
      Matrix3 result;
      result[0][1] = -a[2];
      result[0][2] = a[1];
      result[1][0] = a[2];
      result[1][2] = -a[0];
      result[2][0] = -a[1];
      result[2][1] = a[0];
      return result;
    }

    Matrix3 unit_matrix()
    {
      return unit_symmetric_tensor<3>();
    }

    Matrix3 symmetric_part(const Matrix3 &matrix)
    {
      return 0.5 * (matrix + transpose(matrix));
    }

    void put_block(const Matrix3 &block, const unsigned int row, const unsigned int column,
                   FullMatrix<double> &matrix)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix(3 * row + i, 3 * column + j) += block[i][j];
    }

    /// The sums over the points of a mass; the second moments about its place are tr(I) / 2 - I.
    void fill(const PointMass &given, const GroupMotion &group, const ElasticModel<3> &model,
              AttachedPoint &point)
    {
      for (auto *const matrix : {&point.mass, &point.stiffening, &point.coriolis})
        matrix->reinit(6, 6);
      const double m = given.mass, square = model.rotation.speed * model.rotation.speed;
      const Tensor<1, 3> a = given.place ? *given.place - group.centroid : Tensor<1, 3>(),
                         &e = model.rotation.axis;
      const Matrix3 one = unit_matrix(),
                    second =
                        trace(given.inertia) / 2 * one - Matrix3(given.inertia) + m * outer_product(a, a),
                    along = one - outer_product(e, e);

      put_block(m * one, 0, 0, point.mass);
      put_block(-m * cross_matrix(a), 0, 1, point.mass);
      put_block(m * cross_matrix(a), 1, 0, point.mass);
      put_block(trace(second) * one - second, 1, 1, point.mass);

      const Tensor<1, 3> off_axis = square * (along * (group.centroid - model.rotation.point)),
                         force = m * (model.gravity + off_axis + square * (along * a)),
                         moment = m * cross_product_3d(a, model.gravity + off_axis) +
                                  square * cross_product_3d(e, second * e);
      for (unsigned int d = 0; d < 3; ++d)
      {
        point.load[d] = force[d];
        point.load[3 + d] = moment[d];
      }

      // spin softening, and the forces on points that turn
      const Matrix3 arms = m * outer_product(model.gravity + off_axis, a) + square * (along * second),
                    turn = cross_matrix(invert(group.turning) * moment) * group.second_moment;
      put_block(-m * square * along, 0, 0, point.stiffening);
      put_block(m * square * along * cross_matrix(a), 0, 1, point.stiffening);
      put_block(-m * square * cross_matrix(a) * along, 1, 0, point.stiffening);
      put_block(-square *
                    (trace(second) * one - second - cross_matrix(e) * second * transpose(cross_matrix(e))),
                1, 1, point.stiffening);
      put_block(trace(arms) * one - symmetric_part(arms) + symmetric_part(turn), 1, 1, point.stiffening);

      put_block(m * cross_matrix(e), 0, 0, point.coriolis);
      put_block(-m * cross_matrix(e) * cross_matrix(a), 0, 1, point.coriolis);
      put_block(m * cross_matrix(a) * cross_matrix(e), 1, 0, point.coriolis);
      put_block(cross_matrix(second * e), 1, 1, point.coriolis);
    }
  } // namespace

  std::vector<AttachedPoint> attached_points(const ElasticBody<3> &body)
  {
    std::vector<AttachedPoint> result;
    for (const PointMass &given : body.model.masses)
    {
      const GroupMotion group = group_motion(body, given);
      AttachedPoint point;
      point.centroid = group.centroid;
      // T of the unconstrained dofs
      point.motion.reinit(6, group.rows.size());
      for (const auto &[dof, column] : group.rows)
      {
        for (unsigned int p = 0; p < 6; ++p)
          point.motion(p, point.dofs.size()) = column[p];
        point.dofs.push_back(dof);
      }
      fill(given, group, body.model, point);
      result.push_back(std::move(point));
    }
    return result;
  }

  void attach_masses(ElasticBody<3> &body)
  {
    hold_rigid_groups(body);
    for (const PointMass &mass : body.model.masses)
      group_motion(body, mass);
  }

  void add_places(const std::vector<AttachedPoint> &points, const IndexSet &locally_owned,
                  DynamicSparsityPattern &pattern)
  {
    for (const AttachedPoint &point : points)
      for (const types::global_dof_index dof : point.dofs)
        if (locally_owned.is_element(dof))
          pattern.add_entries(dof, point.dofs.begin(), point.dofs.end(), true);
  }

  void add_masses(const std::vector<AttachedPoint> &points, FullMatrix<double> AttachedPoint::*const part,
                  PETScWrappers::MPI::SparseMatrix &matrix)
  {
    const auto [begin, end] = matrix.local_range();
    for (const AttachedPoint &point : points)
    {
      const unsigned int n = point.dofs.size();
      FullMatrix<double> right(6, n);
      (point.*part).mmult(right, point.motion);
      std::vector<double> row(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        if (point.dofs[i] < begin || point.dofs[i] >= end)
          continue;
        for (unsigned int j = 0; j < n; ++j)
        {
          row[j] = 0;
          for (unsigned int p = 0; p < 6; ++p)
            row[j] += point.motion(p, i) * right(p, j);
        }
        matrix.add(point.dofs[i], point.dofs, row, false);
      }
    }
  }

  void add_loads(const std::vector<AttachedPoint> &points, PETScWrappers::MPI::Vector &load)
  {
    for (const AttachedPoint &point : points)
      for (unsigned int i = 0; i < point.dofs.size(); ++i)
        if (load.in_local_range(point.dofs[i]))
        {
          double sum = 0;
          for (unsigned int p = 0; p < 6; ++p)
            sum += point.motion(p, i) * point.load[p];
          load(point.dofs[i]) += sum;
        }
  }
} // namespace vibrocontact
