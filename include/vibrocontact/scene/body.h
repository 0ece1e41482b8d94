#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/loads.h>
#include <vibrocontact/scene/material.h>
#include <vibrocontact/scene/rotation.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A kind of body that a parameter file may ask for with `set Type = ...`.
  struct BodyType
  {
    /// name in the file; name of the subsection with its own entries
    std::string name, section;
    /// one line for the reader of the file
    std::string help;
    /// makes its description with the defaults
    std::function<std::shared_ptr<BodyDescription>()> make;
  };
  using BodyTypes = std::vector<BodyType>;

  /// The shipped ones: half-space, rigid, wheel, rail, beam rail, block, blade, layer, bar, ring, oscillator,
  /// identified, matrices, mesh. A program may have more (run/tables.h).
  const BodyTypes &body_types();

  /// `subsection <name of the body>`: its type, and one nested subsection per group of entries. Only the
  /// groups that this type uses are declared, so that entries without effect are refused. What its type says of it is asked
  /// of `description`.
  struct BodyParameters
  {
    std::string name;
    std::string type;
    ElasticMaterial material;
    /// materials of the groups of cells, by name and in the order of the entry `Materials`, which decides
    /// before the declaration which subsections of Material exist; empty: `material` for the whole body
    std::vector<std::pair<std::string, ElasticMaterial>> materials;
    LoadParameters loads;
    /// of a type that may turn
    RotationParameters rotation;
    /// the section of its type; copies share it
    std::shared_ptr<BodyDescription> description;
    /// that the type is one of; never null
    std::shared_ptr<const BodyTypes> types = std::make_shared<const BodyTypes>(body_types());

    BodyParameters() : BodyParameters("", "half-space") {}
    /// @throws dealii::ExceptionBase for an unknown type
    BodyParameters(
        const std::string &name, const std::string &type,
        const std::shared_ptr<const BodyTypes> &types = std::make_shared<const BodyTypes>(body_types()));
    const BodyType &body_type() const;
    /// an analytic ring is not
    bool is_meshed() const { return is_solid() || is_revolved() || description->elements(); }
    bool is_solid() const { return description->solid() != nullptr; }
    bool is_revolved() const { return description->revolved() != nullptr; }
    /// a ring that turns with the speed of rolling
    bool rolls() const { return description->rolls(); }
    /// stiffened by the stress of its rotation or its loads
    bool is_prestressed() const { return rotation.turns() || (is_solid() && loads.prestress); }
    /// moves by poles that are made of its modes: a ring or a wheel that rolls, a body with Coriolis forces
    bool has_complex_modes() const { return rolls() || rotation.has_coriolis(); }
    /// known between its own contact points alone, by modes or by Green's functions
    bool is_green() const { return description->has_own_points(); }
    /// a rail without ends, known by its receptance
    bool is_periodic_rail() const { return description->periodic_rail() != nullptr; }
    /// what has poles and no real modes
    bool is_known_by_poles() const
    {
      return description->measured() || has_complex_modes() || is_periodic_rail();
    }
    /// has modes or poles, in which it moves
    bool vibrates() const { return is_meshed() || is_green() || is_periodic_rail(); }
    /// Whether its material or its supports take energy.
    bool has_loss() const { return material_loss_factor() > 0 || description->has_loss(); }
    /// of a solid; others have one stiffness in all directions
    bool may_be_orthotropic() const;
    bool is_orthotropic() const;
    /// of the material, of several the one that loses most; 0 if it has none [-]
    double material_loss_factor() const;
    /// stands under gravity, a traction, a pressure or its own centrifugal forces
    bool has_load() const { return description->has_weight() || loads.any() || rotation.turns(); }
    /// can come into contact in one point only
    bool is_point() const
    {
      const auto points = description->contact_points(1);
      return points && points->n_points() == 1;
    }

    /// Inside the body's subsection; the type has to be set before.
    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;

    /// Height of the axle above the contact point [m] if the body is a wheel; nothing for other bodies.
    std::optional<double> axle_height(double lateral_position) const;
    /// Lateral positions between which the contact of a wheel can lie [m]; nothing for other bodies.
    std::optional<std::pair<double, double>> contact_limits() const;

  private:
    void check_isotropic(const std::string &section) const;
    void check_rotation(const std::string &section) const;

    std::string materials_entry;
  };

  /// A body of a shipped type whose section is @p description.
  template <class Description>
  BodyParameters body_of(const std::string &name, const std::string &type, const Description &description)
  {
    BodyParameters body(name, type);
    body.description = std::make_shared<Description>(description);
    return body;
  }
} // namespace vibrocontact
