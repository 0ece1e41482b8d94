#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/group_motion.h>
#include <vibrocontact/fe/own_faces.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/mpi.h>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Dof = types::global_dof_index;

    /// a dense block of this many dofs has 3e7 entries in M and in K
    constexpr std::size_t most_dofs = 6000;

    /// int N dA [m^2] and int x N dA [m^3] of each dof, by its direction.
    struct ShareOfDof
    {
      double area = 0;
      Point<3> first;
      unsigned int direction = 0;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &area &first &direction;
      }
    };

    struct GroupIntegrals
    {
      double area = 0;
      Point<3> first;
      Tensor<2, 3> second;
      std::map<Dof, ShareOfDof> dofs;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &area &first &second &dofs;
      }
    };

    /// Over the faces of this rank's cells, on unconstrained dofs.
    GroupIntegrals own_integrals(const ElasticBody<3> &body, const PointMass &mass)
    {
      const FiniteElement<3> &scalar = body.element.base_element(0);
      const unsigned int n_nodes = scalar.n_dofs_per_cell();
      FaceValues<3> faces(body.mapping, scalar, n_gauss_points(body.mesh, scalar));
      FEValues<3> nodes(body.mapping, scalar, Quadrature<3>(scalar_node_points<3>(scalar)),
                        update_quadrature_points);
      std::vector<Dof> dofs(body.element.n_dofs_per_cell());
      GroupIntegrals result;
      for (const auto &[cell, f] : own_faces(body.dof_handler, mass.boundaries))
      {
        faces.reinit(cell, f);
        nodes.reinit(typename Triangulation<3>::active_cell_iterator(cell));
        cell->get_dof_indices(dofs);
        std::vector<ShareOfDof> shares(n_nodes);
        for (unsigned int q = 0; q < faces.n_points(); ++q)
        {
          // geometry has no higher degree than the displacement
          Point<3> x;
          for (unsigned int k = 0; k < n_nodes; ++k)
            x += faces.shape_value(k, q) * nodes.quadrature_point(k);
          const double dA = faces.JxW(q);
          result.area += dA;
          result.first += dA * x;
          result.second += dA * outer_product(Tensor<1, 3>(x), Tensor<1, 3>(x));
          for (unsigned int k = 0; k < n_nodes; ++k)
          {
            shares[k].area += faces.shape_value(k, q) * dA;
            shares[k].first += faces.shape_value(k, q) * dA * x;
          }
        }
        for (unsigned int k = 0; k < dofs.size(); ++k)
        {
          const auto [direction, node] = body.element.system_to_component_index(k);
          if (!lies_on_face<3>(body.element.reference_cell(), f, body.node_points[k]))
            continue;
          const auto add = [&, d = direction, n = node](const Dof dof, const double factor)
          {
            // constraints lie across directions in rigid groups: of each direction by itself
            ShareOfDof &sum = result.dofs[3 * dof + d];
            sum.direction = d;
            sum.area += factor * shares[n].area;
            sum.first += factor * shares[n].first;
          };
          if (!body.constraints.is_constrained(dofs[k]))
            add(dofs[k], 1.);
          else
            for (const auto &[dof, factor] : *body.constraints.get_constraint_entries(dofs[k]))
              add(dof, factor);
        }
      }
      return result;
    }
  } // namespace

  GroupMotion group_motion(const ElasticBody<3> &body, const PointMass &mass)
  {
    GroupIntegrals sum;
    for (const GroupIntegrals &one :
         Utilities::MPI::all_gather(body.communicator(), own_integrals(body, mass)))
    {
      sum.area += one.area;
      sum.first += one.first;
      sum.second += one.second;
      for (const auto &[key, shares] : one.dofs)
      {
        ShareOfDof &all = sum.dofs[key];
        all.direction = shares.direction;
        all.area += shares.area;
        all.first += shares.first;
      }
    }
    if (!(sum.area > 0))
      throw InputError("Body '" + body.mesh.name + "': no face is left in the groups of the mass " +
                       mass.name + ": name other ones in Mesh/Mass/" + mass.name + "/Groups.");
    GroupMotion result;
    const Tensor<1, 3> c = sum.first / sum.area;
    result.centroid = Point<3>(c);
    result.second_moment = sum.second - sum.area * outer_product(c, c);
    result.turning = -1. * result.second_moment;
    for (unsigned int d = 0; d < 3; ++d)
      result.turning[d][d] += trace(result.second_moment);
    const Tensor<2, 3> inverse = invert(result.turning);
    for (const auto &[key, shares] : sum.dofs)
    {
      Tensor<1, 3> along;
      along[shares.direction] = 1;
      const Tensor<1, 3> turn = inverse * cross_product_3d(shares.first - shares.area * c, along);
      std::array<double, 6> &row = result.rows[key / 3];
      row[shares.direction] += shares.area / sum.area;
      for (unsigned int d = 0; d < 3; ++d)
        row[3 + d] += turn[d];
    }
    if (result.rows.size() > most_dofs)
      throw InputError("Body '" + body.mesh.name + "': the mass " + mass.name + " follows the mean of " +
                       std::to_string(result.rows.size()) +
                       " degrees of freedom, which would couple all with all; up to " +
                       std::to_string(most_dofs) + " can: name smaller groups in Mesh/Mass/" + mass.name +
                       "/Groups, or set Rigid to true.");
    return result;
  }
} // namespace vibrocontact
