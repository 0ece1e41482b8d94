#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/interface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

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

  void ContactParameters::declare_place(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const List place(Double(), 0, 3), direction(Double(), 3, 3);
    prm.add_parameter(
        "Bodies", bodies,
        "The two bodies that it joins: the one above (the normal points to it), the one below. Units: "
        "none.",
        List(Anything(), 0, 2));
    prm.add_parameter("Origin", origin,
                      "Nominal contact point x, y, z in the coordinates of its first body. Units: m.",
                      List(Double(), 3, 3));
    prm.add_parameter(
        "Origin on body 2", origin_below,
        "The same point in the coordinates of its second body; empty: the same numbers. Units: m.", place);
    prm.add_parameter("Normal", normal,
                      "Direction x, y, z from its second body to its first, of any length. Units: none.",
                      direction);
    prm.add_parameter(
        "Gap", gap,
        "Distance of the two bodies at the nominal point, beside that of their surfaces. Units: m.",
        Double());
    const std::string added = ", added to what Rolling/";
    for (const auto &[entry, value, unit] :
         {std::make_tuple("Longitudinal creepage", &own_creepage.longitudinal, "none"),
          {"Lateral creepage", &own_creepage.lateral, "none"},
          {"Spin", &own_creepage.spin, "1/m"},
          {"Sliding velocity x", &own_creepage.sliding_x, "m/s"},
          {"Sliding velocity y", &own_creepage.sliding_y, "m/s"},
          {"Sliding rotation", &own_creepage.sliding_rotation, "rad/s"}})
      prm.add_parameter(entry, *value,
                        std::string("Of its first body against its second in the frame of this contact") +
                            added + entry + " is there. Units: " + unit + ".",
                        Double(-1000, 1000));
  }

  namespace
  {
    ContactFrame frame_at(const ContactParameters &contact, const std::vector<double> &origin,
                          const char *const entry)
    {
      const auto three = [&](const std::vector<double> &values, const char *const name)
      {
        if (values.size() != 3)
          throw InputError(contact.section + "/" + name + " lists " + std::to_string(values.size()) +
                           " numbers: give three, x, y and z.");
        return std::array<double, 3>{{values[0], values[1], values[2]}};
      };
      const std::array<double, 3> at = three(origin, entry), along = three(contact.normal, "Normal");
      try
      {
        return contact_frame(at, along);
      }
      catch (const InputError &error)
      {
        throw InputError(contact.section + "/Normal is " + error.what() + ": give another one.");
      }
    }
  } // namespace

  ContactFrame ContactParameters::frame() const
  {
    return frame_at(*this, origin, "Origin");
  }

  ContactFrame ContactParameters::frame_below() const
  {
    return origin_below.empty() ? frame() : frame_at(*this, origin_below, "Origin on body 2");
  }

  void ContactParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    if (!name.empty())
      declare_place(prm);
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
    grid.traction = has_consistent_quadrature() ? TractionShape::bilinear : TractionShape::constant;
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
    return std::make_shared<HalfSpaceOperator>(grid, pair, scheme.convection(speed, grid.spacing_x));
  }

  ContactSections ContactSections::with_friction(const double coefficient) const
  {
    ContactSections result = *this;
    for (ContactParameters &contact : result.all)
      contact.friction = coefficient;
    return result;
  }

  namespace
  {
    template <typename Law, typename Make>
    PointLaws<Law> laws_of(const ContactSections &sections, const PlacedContacts &contacts, const Make &make)
    {
      std::vector<std::pair<std::shared_ptr<const Law>, unsigned int>> all;
      for (unsigned int k = 0; k < contacts.all.size(); ++k)
        all.emplace_back(make(sections.all[k]), contacts.all[k].grid.n_points());
      return PointLaws<Law>::of_contacts(all);
    }
  } // namespace

  PointLaws<NormalLaw> normal_law_of_points(const ContactSections &sections, const PlacedContacts &contacts)
  {
    return laws_of<NormalLaw>(sections, contacts, [](const ContactParameters &one) { return one.law(); });
  }

  PointLaws<NormalLaw> normal_law_of_points(const ContactSections &sections, const PlacedContacts &contacts,
                                            const std::string &name)
  {
    return laws_of<NormalLaw>(sections, contacts,
                              [&](const ContactParameters &one) { return one.law(name); });
  }

  PointLaws<FrictionLaw> friction_law_of_points(const ContactSections &sections,
                                                const PlacedContacts &contacts)
  {
    return laws_of<FrictionLaw>(sections, contacts,
                                [](const ContactParameters &one) { return one.law_of_friction(); });
  }

  std::shared_ptr<const ContactOperator> rolling_operator(const PlacedContacts &contacts,
                                                          DenseMatrix compliance, const CreepScheme &scheme,
                                                          const double speed, const DenseMatrix &gradient)
  {
    convert_to_slip_rows(contacts, scheme, speed, compliance);
    if (gradient.m() > 0)
      compliance.add(speed, gradient);
    return std::make_shared<DenseContactOperator>(std::move(compliance));
  }

  ContactProblem rolling_problem(std::shared_ptr<const ContactOperator> A, const ContactInterface &interface,
                                 const CreepScheme &scheme, const Creepage &creepage,
                                 const ContactSections &sections)
  {
    const PlacedContacts &contacts = interface.contacts;
    const unsigned int n = contacts.n_points();
    ContactProblem problem;
    problem.A = std::move(A);
    problem.b = rigid_slip(contacts, scheme, creepage);
    std::copy(interface.gap.begin(), interface.gap.end(), problem.b.begin());
    if (interface.load_jump.size() > 0)
    {
      DenseMatrix jump(3 * n, 1);
      std::copy(interface.load_jump.begin(), interface.load_jump.end(), &jump(0, 0));
      convert_to_slip_rows(contacts, scheme, creepage.speed, jump);
      for (unsigned int i = 0; i < 3 * n; ++i)
        problem.b[i] += jump(i, 0);
    }
    problem.friction_law = friction_law_of_points(sections, contacts);
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      problem.mu.insert(problem.mu.end(), contacts.all[k].grid.n_points(), sections.all[k].friction);
    problem.normal_law = normal_law_of_points(sections, contacts);
    // the hub of body 1 moves down by the approach, which is constant: it slips nowhere
    const DenseMatrix hub = contacts.translation_of(0);
    problem.by_approach.reinit(3 * n);
    problem.to_force.reinit(3 * n);
    for (unsigned int row = 0; row < 3 * n; ++row)
    {
      problem.to_force[row] = hub(row, 2);
      problem.by_approach[row] = row < n ? hub(row, 2) : 0;
    }
    return problem;
  }

  namespace
  {
    enum class Side
    {
      none,
      upstream,
      downstream,
      lateral
    };

    /// Of a grid the side that a point lies at, or next to upstream of what rolls, if the surface goes on there.
    Side open_side(const ContactGrid &grid, const SurfaceEnds &ends, const bool rolls,
                   const unsigned int point)
    {
      const unsigned int i = point % grid.n_x, j = point / grid.n_x, free_at_rest = ends.upstream ? 0 : 1;
      if (i < (rolls ? 2 : free_at_rest))
        return Side::upstream;
      if (i + 1 == grid.n_x && !ends.downstream)
        return Side::downstream;
      if (grid.n_y > 1 && ((j == 0 && !ends.low_y) || (j + 1 == grid.n_y && !ends.high_y)))
        return Side::lateral;
      return Side::none;
    }

    void check_in_grid(const ContactGrid &grid, const ContactParameters &contact, const double speed,
                       const ContactStatus *const status)
    {
      const bool rolls = speed > 0;
      if (grid.whole_surface && (!rolls || contact.friction == 0))
        return;
      const SurfaceEnds ends = contact.ends(grid);
      for (unsigned int point = 0; point < grid.n_points(); ++point)
      {
        const Side side =
            status[point] == ContactStatus::open ? Side::none : open_side(grid, ends, rolls, point);
        if (side == Side::none)
          continue;
        const bool upstream = side == Side::upstream, lateral = side == Side::lateral;
        const std::string name = upstream  ? "upstream"
                                 : lateral ? "lateral"
                                           : "downstream",
                          place = lateral ? "y = " + number_text(grid.y(point))
                                          : "x = " + number_text(grid.x(point)),
                          entry = contact.section + (lateral ? "/Half width" : "/Half length");
        throw InputError("The contact reaches the " + name + " side of the contact grid (" + place + " m)" +
                         (upstream && rolls ? ", where two columns must stay free: " : ": ") +
                         (grid.of_body ? "give the body more contact points" : "enlarge " + entry) +
                         " or lower the load.");
      }
    }
  } // namespace

  void check_contact_in_grid(const PlacedContacts &contacts, const ContactSections &sections,
                             const double speed, const std::vector<ContactStatus> &status)
  {
    unsigned int first = 0;
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const ContactGrid &grid = contacts.all[k].grid;
      // a single point has no neighbours that could touch as well
      if (grid.n_points() > 1)
        check_in_grid(grid, sections.all[k], speed, &status[first]);
      first += grid.n_points();
    }
  }

  std::vector<unsigned int> points_at_open_sides(const PlacedContacts &contacts,
                                                 const ContactSections &sections)
  {
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const ContactGrid &grid = contacts.all[k].grid;
      if (grid.whole_surface || grid.n_points() == 1)
        continue;
      const SurfaceEnds ends = sections.all[k].ends(grid);
      for (unsigned int point = 0; point < grid.n_points(); ++point)
        if (open_side(grid, ends, false, point) != Side::none)
          result.push_back(contacts.first_point(k) + point);
    }
    return result;
  }
} // namespace vibrocontact
