#include <vibrocontact/fe/beam_space.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;
  using namespace beam_field;

  BeamSpace::BeamSpace(const BeamRailParameters &rail)
      : element(FE_Q<1>(rail.degree), n_fields), dof_handler(mesh)
  {
    const double half = rail.length / 2;
    std::vector<double> knots = {-half, 0., half};
    for (const double support : rail.supports())
      for (const int side : {-1, 1})
        knots.push_back(support + side * rail.pad_length / 2);
    double piece_end = half;
    for (unsigned int k = rail.anechoic_lengths.size(); k-- > 0;)
    {
      piece_end -= rail.anechoic_lengths[k];
      knots.insert(knots.end(), {-piece_end, piece_end});
    }
    std::sort(knots.begin(), knots.end());
    std::vector<double> steps;
    double last = -half;
    for (const double knot : knots)
    {
      const double gap = knot - last;
      if (gap < 1e-6)
        continue;
      const unsigned int n = std::ceil(gap / rail.element_length - 1e-6);
      steps.insert(steps.end(), n, gap / n);
      last = knot;
    }
    GridGenerator::subdivided_hyper_rectangle(mesh, {steps}, Point<1>(-half), Point<1>(half));
    dof_handler.distribute_dofs(element);
  }

  BeamPlace::BeamPlace(const BeamSpace &space, const DoFHandler<1>::active_cell_iterator &cell,
                       const double x)
      : space(space), place((x - cell->vertex(0)[0]) / (cell->vertex(1)[0] - cell->vertex(0)[0])),
        dofs(space.element.n_dofs_per_cell())
  {
    cell->get_dof_indices(dofs);
  }

  void BeamPlace::add(std::map<types::global_dof_index, double> &row, const BeamMotion &motion,
                      const double weight) const
  {
    for (unsigned int k = 0; k < dofs.size(); ++k)
    {
      const auto found = motion.find(space.element.system_to_component_index(k).first);
      const double shape = space.element.shape_value(k, Point<1>(place));
      if (found != motion.end() && std::abs(shape) > 1e-14)
        row[dofs[k]] += weight * found->second * shape;
    }
  }

  std::array<BeamMotion, 3> crown_motion(const BeamRailParameters &rail, const double arm_x, const double y)
  {
    const double crown = rail.crown_height(rail.lateral_position), eta = rail.lateral_position + y;
    return {{{{W, 1.}, {tx, eta}, {ty, -arm_x}},
             {{U, 1.}, {ty, crown - rail.centroid_height}, {tz, -eta}},
             {{V, 1.}, {tx, -(crown - rail.shear_centre_height)}, {tz, arm_x}}}};
  }
} // namespace vibrocontact
