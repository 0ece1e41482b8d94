#pragma once

#include <vibrocontact/scene/material.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Springs to rigid ground, spread evenly over a part of the boundary (rail pads under the foot).
  template <int dim>
  struct SpringBed
  {
    dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
    /// stiffness per area in the global directions [N/m^3]
    dealii::Tensor<1, dim> stiffness_per_area;
    /// the bed covers the boundary where x lies in one of these intervals [m]; empty: all of it
    std::vector<std::pair<double, double>> segments;
    /// hysteretic loss factor [-]
    double loss_factor = 0;
  };

  /// Traction on a part of the boundary, global directions [Pa].
  template <int dim>
  struct SurfaceTraction
  {
    dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
    dealii::Tensor<1, dim> traction;
  };

  /// Everything that turns a mesh into a body: materials, support and loads.
  template <int dim>
  struct ElasticModel
  {
    ElasticMaterial material;
    /// materials of the zones that have another one, by material id of the cells
    std::map<dealii::types::material_id, ElasticMaterial> zones;
    /// boundaries whose displacement is zero
    std::vector<dealii::types::boundary_id> held;
    std::vector<SpringBed<dim>> springs;
    std::vector<SurfaceTraction<dim>> tractions;
    /// acceleration of gravity [m/s^2]; zero: none
    dealii::Tensor<1, dim> gravity;

    const ElasticMaterial &material_of(const dealii::types::material_id id) const
    {
      const auto found = zones.find(id);
      return found == zones.end() ? material : found->second;
    }
    bool has_loss() const
    {
      double largest = material.loss_factor;
      for (const auto &zone : zones)
        largest = std::max(largest, zone.second.loss_factor);
      for (const auto &bed : springs)
        largest = std::max(largest, bed.loss_factor);
      return largest > 0;
    }
    bool has_load() const { return gravity.norm() > 0 || !tractions.empty(); }
    /// held or on springs: no motion without energy
    bool is_supported() const { return !held.empty() || !springs.empty(); }
  };
} // namespace vibrocontact
