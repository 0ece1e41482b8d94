#include <vibrocontact/fe/revolved_section.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace dealii;

  double RevolvedSection::hub_place() const
  {
    double low = 1e300, high = -1e300;
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() &&
            std::any_of(model.held.begin(), model.held.end(),
                        [&](const HeldBoundary<3> &part)
                        { return part.boundary == cell->face(f)->boundary_id(); }))
          for (const unsigned int v : {0u, 1u})
          {
            low = std::min(low, cell->face(f)->vertex(v)[0]);
            high = std::max(high, cell->face(f)->vertex(v)[0]);
          }
    return low > high ? 0. : (low + high) / 2;
  }

  Vector<double> RevolvedSection::rigid_motion(const RigidMotion motion) const
  {
    const double hub = hub_place();
    Vector<double> v(n_dofs());
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
    {
      const double a = places[dof][0] - hub, r = places[dof][1];
      const unsigned char c = directions[dof];
      const double across = c == radial ? 1. : c == circumferential ? -1. : 0.;
      switch (motion)
      {
      case RigidMotion::along_axle:
        v(dof) = c == axial;
        break;
      case RigidMotion::about_axle:
        v(dof) = c == circumferential ? r : 0.;
        break;
      case RigidMotion::across_axle:
        v(dof) = across;
        break;
      case RigidMotion::tilt:
        v(dof) = c == axial ? r : -a * across;
      }
    }
    return v;
  }

  Vector<double> RevolvedSection::times_mass(const Cell &cell, const unsigned int n,
                                             const Vector<double> &motion) const
  {
    Vector<double> own(cell.dofs.size()), result(cell.dofs.size());
    for (unsigned int k = 0; k < own.size(); ++k)
      own(k) = motion(cell.dofs[k]);
    cell.M.vmult(result, own);
    result *= n == 0 ? 2 * numbers::PI : numbers::PI;
    return result;
  }

  PETScWrappers::MPI::Vector RevolvedSection::momentum(const unsigned int n,
                                                       const Vector<double> &motion) const
  {
    const AffineConstraints<double> constraints = this->constraints(n);
    PETScWrappers::MPI::Vector result(complete_index_set(n_dofs()), MPI_COMM_SELF);
    for (const Cell &cell : cells)
      constraints.distribute_local_to_global(times_mass(cell, n, motion), cell.dofs, result);
    result.compress(VectorOperation::add);
    return result;
  }

  double RevolvedSection::inertia(const unsigned int n, const Vector<double> &motion,
                                  const Vector<double> &other) const
  {
    double sum = 0;
    for (const Cell &cell : cells)
    {
      const Vector<double> moved = times_mass(cell, n, motion);
      for (unsigned int k = 0; k < moved.size(); ++k)
        sum += other(cell.dofs[k]) * moved(k);
    }
    return sum;
  }
} // namespace vibrocontact
