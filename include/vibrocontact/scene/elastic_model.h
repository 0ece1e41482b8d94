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

  /// Everything that turns a mesh into a body: material, support and loads.
  template <int dim>
  struct ElasticModel
  {
    ElasticMaterial material;
    /// loss factors of zones that differ from the material's, by material id of the cells
    std::map<dealii::types::material_id, double> loss_factors;
    /// boundaries whose displacement is zero
    std::vector<dealii::types::boundary_id> held;
    std::vector<SpringBed<dim>> springs;
    std::vector<SurfaceTraction<dim>> tractions;
    /// acceleration of gravity [m/s^2]; zero: none
    dealii::Tensor<1, dim> gravity;

    double loss_factor(const dealii::types::material_id id) const
    {
      const auto found = loss_factors.find(id);
      return found == loss_factors.end() ? material.loss_factor : found->second;
    }
    bool has_loss() const
    {
      double largest = material.loss_factor;
      for (const auto &zone : loss_factors)
        largest = std::max(largest, zone.second);
      for (const auto &bed : springs)
        largest = std::max(largest, bed.loss_factor);
      return largest > 0;
    }
    bool has_load() const { return gravity.norm() > 0 || !tractions.empty(); }
    /// held or on springs: no motion without energy
    bool is_supported() const { return !held.empty() || !springs.empty(); }
  };
} // namespace vibrocontact
