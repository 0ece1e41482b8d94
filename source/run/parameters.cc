#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/wheel_damper.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  void Parameters::take(const std::shared_ptr<const EntryTables> &from)
  {
    tables = from;
    contacts = ContactParameters({from, &from->laws});
    contact_solver.methods = {from, &from->contact_solvers};
    periodic.bases = {from, &from->time_bases};
    modal_convolution.methods = {from, &from->propagator_types};
  }

  namespace
  {
    /// Beside a list of contacts, section Contact has the solver alone.
    void refuse_single_contact(const ParameterFile &file, ContactParameters single)
    {
      dealii::ParameterHandler prm;
      single.declare_parameters(prm);
      for (const DeclaredParameters::Entry &entry : declared_parameters(prm).entries)
        if (!file.raw_value("Contact", entry.name).empty())
          throw InputError(file.where("Contact", entry.name) +
                           ": Contacts lists several, and section Contact is given as well: set " +
                           entry.name + " in the sections of the contacts, or leave Contacts out");
    }
  } // namespace

  void Parameters::read_lists(const ParameterFile &file, dealii::ParameterHandler &prm,
                              const std::vector<AnalysisType> &known_analyses)
  {
    scene = read_scene_lists(file, known_analyses, {tables, &tables->body_types});
    is_speed_given = !file.raw_value("Rolling", "Speed").empty();
    if (!scene.contacts.empty())
    {
      refuse_single_contact(file, contact());
      const ContactParameters like = contact();
      contacts.all.assign(scene.contacts.size(), like);
      for (unsigned int k = 0; k < scene.contacts.size(); ++k)
        contacts.all[k].section = contacts.all[k].name = scene.contacts[k];
    }
    declare(prm);
  }

  void Parameters::declare(dealii::ParameterHandler &prm)
  {
    scene.declare_parameters(prm);
    const auto declare = [&](const std::string &section, auto &group)
    {
      prm.enter_subsection(section);
      group.declare_parameters(prm);
      prm.leave_subsection();
    };
    for (const BodyParameters &body : scene.bodies)
      if (body.is_meshed())
      {
        prm.enter_subsection(body.name);
        declare("Modes", modes[body.name]);
        if (body.is_solid())
          declare("Solver", stiffness_solvers[body.name]);
        prm.leave_subsection();
      }
    declare("Output", output);
    for (ContactParameters &one : contacts.all)
      declare(one.section, one);
    prm.enter_subsection("Contact");
    declare("Solver", contact_solver);
    prm.leave_subsection();
    declare("Rolling", rolling);
    declare("Loading", loading);
    prm.enter_subsection("Transient");
    transient.declare_parameters(prm);
    declare("Signals", signals);
    prm.leave_subsection();
    declare("Limit cycle", limit_cycle);
    declare("Stability", stability);
    declare("Frequency response", frequency_response);
    declare("Road", road);
    prm.enter_subsection("Modal convolution");
    modal_convolution.declare_parameters(prm);
    // those of other analyses are partners in contact
    for (unsigned int k = 1; k < scene.bodies.size(); ++k)
      if (scene.bodies[k].is_green() && !scene.bodies[k].is_meshed())
        comparison.further_bodies[scene.bodies[k].name];
    declare("Comparison", comparison);
    prm.leave_subsection();
    declare("Identification", identification);
    declare("Periodic", periodic);
    for (const AnalysisType &type : scene.known_analyses)
      if (!type.sweep_section.empty())
        declare(type.sweep_section, sweeps[type.name]);
  }

  bool Parameters::touches_in_a_point() const
  {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [](const BodyParameters &body) { return body.is_point(); });
  }

  bool Parameters::has_identification() const
  {
    return scene.runs("identification") ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [](const BodyParameters &body) {
                         return body.description->measured() && body.description->measured()->takes_data();
                       });
  }

  std::pair<unsigned int, unsigned int> Parameters::bodies_of_contact(const unsigned int k) const
  {
    const auto place = [&](const std::string &name) -> unsigned int
    {
      const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                      [&](const BodyParameters &body) { return body.name == name; });
      return found - scene.bodies.begin();
    };
    const ContactParameters &one = contacts.all[k];
    return one.name.empty() ? std::make_pair(0u, 1u)
                            : std::make_pair(place(one.bodies.at(0)), place(one.bodies.at(1)));
  }

  ContactGrid Parameters::contact_grid(const unsigned int k) const
  {
    const auto [above, below] = bodies_of_contact(k);
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      if (!contacts.all[k].name.empty() && b != above && b != below)
        continue;
      if (const auto own = scene.bodies[b].description->contact_points(contacts.all[k].spacing))
        return *own;
    }
    return contacts.all[k].grid();
  }

  PlacedContacts Parameters::placed_contacts() const
  {
    PlacedContacts placed;
    placed.all.clear();
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const ContactParameters &one = contacts.all[k];
      const auto [above, below] = bodies_of_contact(k);
      placed.all.push_back(
          {one.name, contact_grid(k), one.frame(), one.frame_below().origin, above, below, one.own_creepage});
    }
    return placed;
  }

  std::vector<ContactPlace> Parameters::places(const unsigned int k) const
  {
    std::vector<ContactPlace> result;
    for (unsigned int c = 0; c < contacts.all.size() && has_contact(); ++c)
    {
      const ContactParameters &one = contacts.all[c];
      const auto [above, below] = bodies_of_contact(c);
      if (one.name.empty())
        result.push_back({body_grid(k), ContactFrame(), k == 0});
      else if (k == above)
        result.push_back({contact_grid(c), one.frame(), true});
      else if (k == below)
        result.push_back({contact_grid(c), one.frame_below(), false});
    }
    return result;
  }

  bool Parameters::is_above(const unsigned int k) const
  {
    for (unsigned int c = 0; c < contacts.all.size() && !scene.contacts.empty(); ++c)
    {
      const auto [above, below] = bodies_of_contact(c);
      if (k == above || k == below)
        return k == above;
    }
    return k == 0;
  }

  const ParameterSweep *Parameters::lateral_sweep() const
  {
    for (const AnalysisType &type : scene.known_analyses)
      if (type.sweeps_band && scene.runs(type.name) &&
          sweeps.at(type.name).sweeps(ParameterSweep::lateral_position))
        return &sweeps.at(type.name);
    return nullptr;
  }

  Parameters::LateralPositions Parameters::lateral_positions() const
  {
    LateralPositions positions;
    const ParameterSweep *const sweep = lateral_sweep();
    if (!sweep)
      return positions;
    const ParameterSweep::Axis &axis =
        sweep->first.entry == ParameterSweep::lateral_position ? sweep->first : sweep->second;
    for (const std::string &text : axis.values())
    {
      char *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (*end != 0 || !std::isfinite(value))
        throw InputError("Stability/Sweep/Values lists " + text +
                         " for Contact/Lateral position: give numbers in m.");
      const ContactGrid grid = contact_grid_at(value);
      const double two_rows = 1.999 * grid.spacing_y;
      const bool lies_on = grid.n_y > 0 && grid.y(0) <= -two_rows && grid.y(grid.n_points() - 1) >= two_rows;
      (lies_on ? positions.kept : positions.left_out).push_back(value);
    }
    if (positions.kept.empty())
      throw InputError(
          "Contact/Lateral position is swept, but none of its values lies on the tread of body " +
          scene.bodies[0].name + ", two rows of contact points from its ends: choose others.");
    return positions;
  }

  ContactGrid Parameters::contact_grid_at(const double lateral_position) const
  {
    const auto limits = scene.bodies[0].contact_limits();
    const ContactGrid grid = contact_grid();
    return limits ? clipped(grid, limits->first - lateral_position, limits->second - lateral_position) : grid;
  }

  double Parameters::position_on_grid(const double position) const
  {
    const double nominal = contact().lateral_position, spacing = contact_grid().spacing_y;
    if (!scene.bodies[0].description->revolved())
      return nominal;
    constexpr double finest = 1e-6;
    const double steps = (position - nominal) / spacing,
                 rest = finest * std::round((steps - std::floor(steps + finest)) / finest);
    return rest == 0 ? nominal : nominal + rest * spacing;
  }

  ContactGrid Parameters::body_grid(const unsigned int k) const
  {
    const ContactGrid grid = contact_grid();
    std::vector<double> positions = lateral_positions().kept;
    const double nominal = contact().lateral_position;
    positions.erase(std::remove_if(positions.begin(), positions.end(),
                                   [&](const double position)
                                   { return position_on_grid(position) != nominal; }),
                    positions.end());
    if (k != 0 || positions.empty() || !scene.bodies[0].is_meshed())
      return grid;
    for (const double position : positions)
      band(grid, position - nominal, position - nominal);
    const ContactGrid whole = band(grid, *std::min_element(positions.begin(), positions.end()) - nominal,
                                   *std::max_element(positions.begin(), positions.end()) - nominal);
    const auto limits = scene.bodies[0].contact_limits();
    return limits ? clipped(whole, limits->first - nominal, limits->second - nominal) : whole;
  }

  std::shared_ptr<const NormalLaw> Parameters::periodic_law(const unsigned int k) const
  {
    const std::string own = periodic.own_law();
    return own.empty() ? contacts.all[k].law() : contacts.all[k].law(own);
  }

  PointLaws<NormalLaw> Parameters::periodic_laws() const
  {
    if (contacts.all.size() == 1)
      return periodic_law(0);
    const std::string own = periodic.own_law();
    return own.empty() ? normal_law_of_points(contacts, placed_contacts())
                       : normal_law_of_points(contacts, placed_contacts(), own);
  }

  DeclaredParameters read_parameters(ParameterFile &file, dealii::ParameterHandler &prm,
                                     Parameters &parameters, const std::vector<AnalysisType> &known_analyses,
                                     const std::shared_ptr<const EntryTables> &tables)
  {
    try
    {
      parameters.take(tables);
      parameters.read_lists(file, prm, known_analyses);
      for (const auto &[entry, alternative] :
           {std::make_pair("Rolling/Normal force", "Rolling/Hub displacement"),
            std::make_pair("Contact/Friction coefficient", "Rolling/Sweep/Friction coefficient")})
      {
        const std::string dropped = file.prefer_option(entry, alternative);
        if (!dropped.empty())
          run_log().line(dropped + " of the file is left out: an option gives its alternative.");
      }
      DeclaredParameters declared = file.parse(prm);
      if (parameters.has_contact() || parameters.scene.runs("periodic"))
        for (ContactParameters &contact : parameters.contacts.all)
          contact.read_curves(parameters.periodic.own_law());
      parameters.check();
      parameters.find_flat_faces();
      return declared;
    }
    catch (const InputError &error)
    {
      throw InputError(file.located(error.what()));
    }
  }

  namespace
  {
    std::string commented(const std::string &what, const DeclaredParameters &parameters)
    {
      std::istringstream lines(print_parameters(parameters, ParameterStyle::documented));
      std::string text = "\n\n# " + what + " has these entries:\n#\n";
      for (std::string line; std::getline(lines, line);)
        if (!line.empty())
          text += "# " + line + "\n";
      return text;
    }

    /// The section of a body as comments: an example for a type that the printed file does not use.
    std::string commented_body(const BodyType &type, const std::shared_ptr<const EntryTables> &tables)
    {
      Parameters parameters;
      parameters.take(tables);
      const BodyParameters body(type.name, type.name, {tables, &tables->body_types});
      parameters.scene.bodies = {body};
      dealii::ParameterHandler prm;
      parameters.declare(prm);
      const DeclaredParameters all = declared_parameters(prm);
      DeclaredParameters own;
      const auto belongs = [&](const std::string &section)
      { return section == body.name || section.compare(0, body.name.size() + 1, body.name + "/") == 0; };
      for (const auto &entry : all.entries)
        if (belongs(entry.section))
          own.entries.push_back(entry);
      for (const auto &section : all.sections)
        if (belongs(section))
          own.sections.push_back(section);
      return commented("A body of type " + type.name + " (" + type.help + ")", own);
    }

    /// The same of a damper, which has a section of its name in a wheel's.
    std::string commented_damper()
    {
      dealii::ParameterHandler prm;
      WheelDamper damper;
      for (const char *const section : {"wheel", "Wheel", "Damper", "NAME"})
        prm.enter_subsection(section);
      damper.declare_parameters(prm);
      for (unsigned int k = 0; k < 4; ++k)
        prm.leave_subsection();
      return commented("A damper NAME that wheel/Wheel/Dampers lists (Model = harmonics)",
                       declared_parameters(prm));
    }
  } // namespace

  std::string all_parameters(const std::vector<AnalysisType> &known_analyses,
                             const std::shared_ptr<const EntryTables> &tables)
  {
    ParameterFile file("", "set Title = Wheel on rail\n"
                           "set Bodies = wheel, rail\n"
                           "set Analyses = modes, quasi-static rolling\n"
                           "subsection wheel\n set Type = wheel\n"
                           " subsection Modes\n set Upper frequency = 8000\n end\nend\n"
                           "subsection rail\n set Type = rail\nend\n"
                           "subsection Rolling\n set Hub displacement = 0.35e-3\nend\n");
    Parameters parameters;
    dealii::ParameterHandler prm;
    const DeclaredParameters declared = read_parameters(file, prm, parameters, known_analyses, tables);
    std::string text = "# Every parameter of vibrocontact " + version() + ", for a wheel on a rail.\n\n" +
                       print_parameters(declared, ParameterStyle::documented);
    for (const BodyType &type : tables->body_types)
      if (type.name != "wheel" && type.name != "rail")
        text += commented_body(type, tables);
    return text + commented_damper();
  }
} // namespace vibrocontact
