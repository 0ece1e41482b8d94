#pragma once

#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/base/parameter_group.h>
#include <vibrocontact/scene/bar.h>
#include <vibrocontact/scene/beam_rail.h>
#include <vibrocontact/scene/blade.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/contact_grid.h>
#include <vibrocontact/scene/half_space_body.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/layer.h>
#include <vibrocontact/scene/loads.h>
#include <vibrocontact/scene/material.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/oscillator.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/ring.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  struct BodyParameters;
  struct SecondOrderSystem;

  /// Entries and elements of a type of body that a program of its own adds (doc/extending.md). It has a section
  /// Material and a section Modes beside its own entries.
  class ElementBody : public ParameterGroup
  {
  public:
    /// its own contact points, as the one of a bar; nothing: the grid of section Contact
    virtual std::optional<ContactGrid> contact_grid() const { return {}; }
    /// Mass, stiffness and, on the grid, the contact trace (fe/second_order_system.h). Collective.
    /// @param above whether it is body 1, above the plane of contact
    /// @param grid of the contact points; null if no analysis has contact
    virtual std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                        const ContactGrid *grid,
                                                        MPI_Comm communicator) const = 0;
  };

  /// A kind of body that a parameter file may ask for with `set Type = ...`.
  struct BodyType
  {
    /// name in the file; name of the subsection with its own entries
    std::string name, section;
    /// one line for the reader of the file
    std::string help;
    /// made of finite elements: has modes
    bool is_meshed;
    /// a solid of hexahedra: has loads and fields
    bool is_solid;
    /// makes the entries and elements of a type that a program adds (is_meshed, no solid); empty for the shipped ones
    std::function<std::shared_ptr<ElementBody>()> make = {};
  };
  using BodyTypes = std::vector<BodyType>;

  /// The shipped ones: half-space, rigid, wheel, rail, beam rail, block, blade, layer, bar, ring, oscillator,
  /// identified, mesh. A program may have more (run/tables.h).
  const BodyTypes &body_types();

  /// `subsection <name of the body>`: its type, and one nested subsection per group of entries. Only the
  /// groups that this type uses are declared, so that entries without effect are refused.
  struct BodyParameters
  {
    std::string name;
    std::string type = "half-space";
    ElasticMaterial material;
    /// materials of the groups of cells, by name and in the order of the entry `Materials`, which decides
    /// before the declaration which subsections of Material exist; empty: `material` for the whole body
    std::vector<std::pair<std::string, ElasticMaterial>> materials;
    HalfSpaceParameters half_space;
    BlockParameters block;
    BladeParameters blade;
    LayerParameters layer;
    BarParameters bar;
    IdentifiedParameters identified;
    RingParameters ring;
    OscillatorParameters oscillator;
    WheelParameters wheel;
    RailParameters rail;
    BeamRailParameters beam_rail;
    MeshFileParameters mesh;
    LoadParameters loads;
    /// of a type that a program adds, null for others
    std::shared_ptr<ElementBody> own;
    /// that the type is one of; never null
    std::shared_ptr<const BodyTypes> types = std::make_shared<const BodyTypes>(body_types());

    const BodyType &body_type() const;
    /// an analytic ring is not
    bool is_meshed() const;
    bool is_solid() const { return body_type().is_solid; }
    /// has Material; others bring their own stiffness
    bool has_material() const { return type != "rigid" && !is_green(); }
    /// has a mesh whose groups of cells may have materials of their own
    bool has_groups() const { return type == "wheel" || type == "rail" || type == "mesh"; }
    /// a ring that turns with the speed of rolling
    bool rolls() const { return type == "ring" && ring.rolling; }
    /// known between its own contact points alone, by modes or by Green's functions
    bool is_green() const { return type == "identified" || type == "ring" || type == "oscillator"; }
    /// of these, what has poles and no real modes
    bool is_known_by_poles() const { return type == "identified" || rolls(); }
    /// has modes or poles, in which it moves
    bool vibrates() const { return is_meshed() || is_green(); }
    /// all of its flexibility has mass: a force moves its contact points by their inertia alone
    bool has_rigid_points() const
    {
      return type == "oscillator" || (type == "identified" && identified.tread_stiffness == 0) ||
             (type == "ring" && !is_meshed() && !ring.residual && ring.tread_stiffness == 0);
    }
    /// turns about an axle, built in or from a mesh file: its modes have labels and Eq. 23's damping
    bool is_wheel() const { return type == "wheel" || (type == "mesh" && mesh.is_wheel()); }
    /// Whether its material or its supports take energy.
    bool has_loss() const;
    /// of the material, of several the one that loses most [-]
    double material_loss_factor() const;
    /// Its own contact points, if it brings some; nothing: those of the grid of section Contact.
    /// @param cell size of the cell of a point that has none of its own [m]
    std::optional<ContactGrid> contact_points(double cell) const;
    /// its only point has no cell of its own but one of Contact/Grid spacing
    bool takes_cell() const { return type == "oscillator" || type == "identified"; }
    /// its contact points look down: it is the body above
    bool touches_downwards_only() const
    {
      return type == "ring" || (type == "identified" && identified.radius > 0);
    }
    /// can come into contact in one point only
    bool is_point() const
    {
      const auto points = contact_points(1);
      return points && points->n_points() == 1;
    }

    /// Inside the body's subsection; the type has to be set before.
    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;

    /// The outline of a wheel's section; nothing for other bodies. Reads the file.
    std::optional<SectionOutline> wheel_section() const;
    /// Height of the axle above the contact point [m] if the body is a wheel; nothing for other bodies.
    std::optional<double> axle_height(double lateral_position) const;
    /// Lateral positions between which the contact of a wheel can lie [m]; nothing for other bodies.
    std::optional<std::pair<double, double>> contact_limits() const;
    /// The rectangle that is all of the contact surface of a block, or of a mesh file whose contact group is
    /// one; nothing for other bodies. Reads the file.
    std::optional<FlatFace> flat_face(double lateral_position) const;

  private:
    std::string materials_entry;
  };
} // namespace vibrocontact
