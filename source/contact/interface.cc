#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/interface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// "a (what it is), b (...)", for the help of an entry
    template <typename Entry>
    std::string help_of(const std::vector<Entry> &table)
    {
      std::string help;
      for (const Entry &entry : table)
        help += (help.empty() ? "" : ", ") + entry.name + " (" + entry.help + ")";
      return help;
    }

    /// Entries of all laws, each once, beside the coefficient of friction.
    std::vector<LawParameter> law_parameters(const ContactLaws &laws)
    {
      std::vector<LawParameter> all;
      const auto add = [&](const std::vector<LawParameter> &parameters)
      {
        for (const LawParameter &parameter : parameters)
          if (parameter.name != friction_coefficient().name &&
              std::none_of(all.begin(), all.end(),
                           [&](const LawParameter &known) { return known.name == parameter.name; }))
            all.push_back(parameter);
      };
      for (const FrictionLawEntry &entry : laws.friction)
        add(entry.parameters);
      for (const NormalLawEntry &entry : laws.normal)
        add(entry.parameters);
      return all;
    }
  } // namespace

  ContactParameters::ContactParameters(std::shared_ptr<const ContactLaws> laws) : laws(std::move(laws))
  {
    for (const LawParameter &parameter : law_parameters(*this->laws))
      law_values.text(parameter);
  }

  void ContactParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const LawParameter mu = friction_coefficient();
    prm.add_parameter(mu.name, friction, mu.help, *mu.pattern);
    prm.add_parameter("Grid spacing", spacing, "Distance of the contact points along x and y. Units: m.",
                      Double(1e-6, 0.1));
    prm.add_parameter("Half length", half_length,
                      "The grid of potential contact covers x from minus this to plus this. Units: m.",
                      Double(1e-6, 1));
    prm.add_parameter("Half width", half_width,
                      "The grid of potential contact covers y from minus this to plus this. Units: m.",
                      Double(1e-6, 1));
    prm.add_parameter(
        "Strip length", strip_length,
        "Line contact: one row of contact cells of this length along y; 0 for a grid. Units: m.",
        Double(0, 1e3));
    prm.add_parameter("Offset x", offset_x,
                      "Shift of the grid against the nominal contact point, in grid spacings. Units: none.",
                      Double(-0.5, 0.5));
    prm.add_parameter("Offset y", offset_y,
                      "Shift of the grid against the nominal contact point, in grid spacings. Units: none.",
                      Double(-0.5, 0.5));
    prm.add_parameter("Lateral position", lateral_position,
                      "Lateral coordinate of the nominal contact point in the section of body 1. Units: m.",
                      Double(-1, 1));
    prm.add_parameter("Creep scheme", creep_scheme,
                      "Upwind difference of the convective part of the slip. Units: none.",
                      Selection(selection(names_of(creep_schemes()))));
    prm.add_parameter(
        "Quadrature", quadrature,
        "Traction constant on each contact cell (lumped) or bilinear between the contact points "
        "(consistent); meshed bodies only. Units: none.",
        Selection("lumped|consistent"));
    prm.add_parameter(
        "Local flexibility", local_flexibility,
        "What solid bodies add to their modes: the residual flexibility of their finite elements, or that of "
        "a half-space of their material in place of it. Units: none.",
        Selection("finite elements|half-space"));
    prm.add_parameter("Normal-tangential coupling", coupling,
                      "Whether the local flexibility couples normal and tangential directions; the coupling "
                      "by the modes stays. Units: none.",
                      Bool());
    prm.add_parameter("Normal law", normal_law,
                      "Law between gap and normal force: " + help_of(laws->normal) + ". Units: none.",
                      Selection(selection(names_of(laws->normal))));
    prm.add_parameter("Friction law", friction_law,
                      "Coefficient of friction over the slip speed: " + help_of(laws->friction) +
                          "; empty: falling friction where Static friction ratio is not 1, else coulomb. "
                          "Units: none.",
                      Selection("|" + selection(names_of(laws->friction))));
    for (const LawParameter &parameter : law_parameters(*laws))
      prm.add_parameter(parameter.name, law_values.text(parameter), parameter.help, *parameter.pattern);
  }

  void ContactParameters::read_curves(const std::string &further)
  {
    for (const std::string &name : {normal_law, further.empty() ? normal_law : further})
    {
      law_values.read_curves(find_normal_law(name, laws->normal).parameters);
      law(name);
    }
    const FrictionLawEntry &entry = friction_entry();
    law_values.read_curves(entry.parameters);
    // what the law does not take from the coefficient it says itself
    if (!takes_coefficient())
      friction = law_of_friction()->coefficient(std::numeric_limits<double>::infinity()).value;
    law_of_friction();
  }

  ContactGrid ContactParameters::grid() const
  {
    const auto half = [&](const double extent) -> unsigned int { return std::ceil(extent / spacing - 1e-6); };
    const unsigned int n_x = half(half_length), n_y = half(half_width);
    ContactGrid grid;
    grid.n_x = 2 * n_x + 1;
    grid.n_y = 2 * n_y + 1;
    grid.spacing_x = grid.spacing_y = spacing;
    grid.x_first = (offset_x - n_x) * spacing;
    grid.y_first = (offset_y - n_y) * spacing;
    grid.traction = quadrature == "consistent" ? TractionShape::bilinear : TractionShape::constant;
    if (strip_length > 0)
    {
      grid.n_y = 1;
      grid.spacing_y = strip_length;
      grid.y_first = 0;
    }
    for (const FlatFace &face : flat_faces)
      grid = fitted(grid, face, at_rest);
    return grid;
  }

  SurfaceEnds ContactParameters::ends(const ContactGrid &grid) const
  {
    SurfaceEnds result;
    for (const FlatFace &face : flat_faces)
      result.add(grid, face);
    return result;
  }

  std::shared_ptr<const NormalLaw> ContactParameters::law(const std::string &name) const
  {
    const NormalLawEntry &entry = find_normal_law(name, laws->normal);
    return entry.make(law_values.numbers(entry.parameters));
  }

  const FrictionLawEntry &ContactParameters::friction_entry() const
  {
    const std::string by_ratio =
        law_values.number("Static friction ratio") == 1 ? "coulomb" : "falling friction";
    return find_friction_law(friction_law.empty() ? by_ratio : friction_law, laws->friction);
  }

  bool ContactParameters::takes_coefficient() const
  {
    const std::vector<LawParameter> parameters = friction_entry().parameters;
    return std::any_of(parameters.begin(), parameters.end(),
                       [](const LawParameter &one) { return one.name == friction_coefficient().name; });
  }

  std::shared_ptr<const FrictionLaw> ContactParameters::law_of_friction(const double coefficient) const
  {
    const FrictionLawEntry &entry = friction_entry();
    return entry.make(law_values.numbers(entry.parameters, {{friction_coefficient().name, coefficient}}));
  }

  std::shared_ptr<const ContactOperator> rolling_operator(const ContactGrid &grid, const HalfSpacePair &pair,
                                                          const CreepScheme &scheme, const double speed)
  {
    return std::make_shared<HalfSpaceRollingOperator>(grid, pair, scheme, speed);
  }

  std::shared_ptr<const ContactOperator> rolling_operator(const ContactGrid &grid, DenseMatrix compliance,
                                                          const CreepScheme &scheme, const double speed)
  {
    convert_to_slip_rows(grid, scheme, speed, compliance);
    return std::make_shared<DenseContactOperator>(std::move(compliance));
  }

  ContactProblem rolling_problem(std::shared_ptr<const ContactOperator> A, const ContactInterface &interface,
                                 const CreepScheme &scheme, const Creepage &creepage,
                                 const ContactParameters &parameters)
  {
    const unsigned int n = interface.grid.n_points();
    ContactProblem problem;
    problem.A = std::move(A);
    problem.b = rigid_slip(interface.grid, scheme, creepage);
    std::copy(interface.gap.begin(), interface.gap.end(), problem.b.begin());
    if (interface.load_jump.size() > 0)
    {
      DenseMatrix jump(3 * n, 1);
      std::copy(interface.load_jump.begin(), interface.load_jump.end(), &jump(0, 0));
      convert_to_slip_rows(interface.grid, scheme, creepage.speed, jump);
      for (unsigned int i = 0; i < 3 * n; ++i)
        problem.b[i] += jump(i, 0);
    }
    problem.friction_law = parameters.law_of_friction();
    problem.mu.assign(n, parameters.friction);
    problem.normal_law = parameters.law();
    return problem;
  }

  void check_contact_in_grid(const ContactGrid &grid, const ContactParameters &contact, const double speed,
                             const std::vector<ContactStatus> &status)
  {
    if (grid.whole_surface)
      return;
    const SurfaceEnds ends = contact.ends(grid);
    const bool rolls = speed > 0;
    const unsigned int free_upstream = rolls ? 2 : ends.upstream ? 0 : 1;
    const std::string larger_x = "enlarge Contact/Half length", larger_y = "enlarge Contact/Half width";
    for (unsigned int point = 0; point < grid.n_points(); ++point)
    {
      if (status[point] == ContactStatus::open)
        continue;
      const unsigned int i = point % grid.n_x, j = point / grid.n_x;
      if (i < free_upstream)
        throw InputError(
            "The contact reaches the upstream side of the contact grid (x = " + number_text(grid.x(point)) +
            " m)" + (rolls ? ", where two columns must stay free: " : ": ") + larger_x +
            " or lower the load.");
      if (i + 1 == grid.n_x && !ends.downstream)
        throw InputError("The contact reaches the downstream side of the contact grid (x = " +
                         number_text(grid.x(point)) + " m): " + larger_x + " or lower the load.");
      if (grid.n_y > 1 && ((j == 0 && !ends.low_y) || (j + 1 == grid.n_y && !ends.high_y)))
        throw InputError("The contact reaches the lateral side of the contact grid (y = " +
                         number_text(grid.y(point)) + " m): " + larger_y + " or lower the load.");
    }
  }
} // namespace vibrocontact
