#pragma once

#include <vibrocontact/scene/material.h>
#include <vibrocontact/scene/point_mass.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <array>
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
    /// of dashpots beside the springs [N s/m^3]
    dealii::Tensor<1, dim> damping_per_area;
  };

  /// Traction on a part of the boundary, global directions [Pa].
  template <int dim>
  struct SurfaceTraction
  {
    dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
    dealii::Tensor<1, dim> traction;
  };

  /// Pressure on a part of the boundary, against its outward normal [Pa].
  struct SurfacePressure
  {
    dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
    double pressure = 0;
  };

  /// A part of the boundary whose displacement is zero, in all directions or in some of them.
  template <int dim>
  struct HeldBoundary
  {
    HeldBoundary(const dealii::types::boundary_id boundary) : boundary(boundary) { directions.fill(true); }
    HeldBoundary(const dealii::types::boundary_id boundary, const std::array<bool, dim> &directions)
        : boundary(boundary), directions(directions)
    {
    }
    bool is_clamped() const
    {
      return std::all_of(directions.begin(), directions.end(), [](const bool held) { return held; });
    }

    dealii::types::boundary_id boundary;
    std::array<bool, dim> directions;
  };

  /// A body that turns steadily about an axis, seen in axes that turn with it (fe/prestress.h).
  template <int dim>
  struct SteadyRotation
  {
    /// Omega about the axis, right-handed; 0: it does not turn [rad/s]
    double speed = 0;
    /// unit vector
    dealii::Tensor<1, dim> axis;
    /// any point of the axis [m]
    dealii::Point<dim> point;
    /// whether Coriolis forces are taken
    bool coriolis = true;

    /// Omega^2 times the way from the axis [m/s^2]
    dealii::Tensor<1, dim> centrifugal(const dealii::Point<dim> &x) const
    {
      const dealii::Tensor<1, dim> way = x - point;
      return speed * speed * (way - (way * axis) * axis);
    }
  };

  /// Everything that turns a mesh into a body: materials, support and loads.
  template <int dim>
  struct ElasticModel
  {
    ElasticMaterial material;
    /// materials of the zones that have another one, by material id of the cells
    std::map<dealii::types::material_id, ElasticMaterial> zones;
    std::vector<HeldBoundary<dim>> held;
    std::vector<SpringBed<dim>> springs;
    /// coupled to parts of the boundary, of bodies in three dimensions
    std::vector<PointMass> masses;
    std::vector<SurfaceTraction<dim>> tractions;
    std::vector<SurfacePressure> pressures;
    /// acceleration of gravity [m/s^2]; zero: none
    dealii::Tensor<1, dim> gravity;
    SteadyRotation<dim> rotation;
    /// the stress of its loads stiffens it (fe/prestress.h); of one that turns it always does
    bool prestressed = false;

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
    bool has_damping() const
    {
      return std::any_of(springs.begin(), springs.end(),
                         [](const SpringBed<dim> &bed) { return bed.damping_per_area.norm() > 0; });
    }
    bool turns() const { return rotation.speed != 0; }
    bool has_body_force() const { return gravity.norm() > 0 || turns(); }
    bool has_load() const { return has_body_force() || !tractions.empty() || !pressures.empty(); }
    bool is_prestressed() const { return turns() || (prestressed && has_load()); }
    /// what holds it holds all directions
    bool is_clamped() const
    {
      return !held.empty() && std::all_of(held.begin(), held.end(),
                                          [](const HeldBoundary<dim> &part) { return part.is_clamped(); });
    }
    /// held or on springs: no motion without energy
    bool is_supported() const { return !held.empty() || !springs.empty(); }
  };
} // namespace vibrocontact
