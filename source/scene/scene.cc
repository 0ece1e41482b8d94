#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/scene.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// Sections at the top level that are not bodies.
    const std::vector<std::string> reserved_names = {"Output",
                                                     "Contact",
                                                     "Rolling",
                                                     "Solver",
                                                     "Modes",
                                                     "Road",
                                                     "Transient",
                                                     "Tyre",
                                                     "Frequency response",
                                                     "Identification",
                                                     "Modal convolution",
                                                     "Periodic",
                                                     "Stability"};

    bool contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    void check_body_name(const ParameterFile &file, const std::string &name,
                         const std::vector<std::string> &names, const std::vector<std::string> &reserved)
    {
      const std::string where = file.where("", "Bodies") + ": ";
      if (std::count(names.begin(), names.end(), name) > 1)
        throw InputError(where + "the body \"" + name + "\" is listed twice; give each body its own name");
      if (contains(reserved, name))
        throw InputError(where + "\"" + name +
                         "\" cannot name a body, it names another section; choose another name");
      for (const char c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-')
          throw InputError(where + "the name of body \"" + name +
                           "\" may hold letters, digits, _ and - only; separate names by commas");
      if (file.has_section(name))
        return;
      std::vector<std::string> others;
      for (const auto &section : file.top_sections())
        if (!contains(reserved, section) && !contains(names, section))
          others.push_back(section);
      throw InputError(where + "there is no section of the body \"" + name + "\"; " +
                       (nearest_names(name, others).empty() ? "add \"subsection " + name + "\" with its Type"
                                                            : name_suggestion(name, others)));
    }

    std::vector<std::string> read_contacts(const ParameterFile &file, const std::vector<std::string> &bodies,
                                           const std::vector<std::string> &reserved)
    {
      const std::vector<std::string> names = file.list("Contacts");
      const std::string where = file.where("", "Contacts") + ": ";
      for (const std::string &name : names)
      {
        if (std::count(names.begin(), names.end(), name) > 1)
          throw InputError(where + "the contact \"" + name +
                           "\" is listed twice; give each contact its own name");
        if (contains(reserved, name) || contains(bodies, name))
          throw InputError(where + "\"" + name + "\" cannot name a contact, it names " +
                           (contains(bodies, name) ? "a body" : "another section") + "; choose another name");
        for (const char c : name)
          if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-')
            throw InputError(where + "the name of contact \"" + name +
                             "\" may hold letters, digits, _ and - only; separate names by commas");
        if (!file.has_section(name))
          throw InputError(where + "there is no section of the contact \"" + name + "\"; add \"subsection " +
                           name + "\" with the entries of Contact and its two Bodies");
      }
      return names;
    }

    /// Which subsections of Material there are. Each says what it is made of: a default beside another material
    /// would be a guess.
    void read_materials(const ParameterFile &file, BodyParameters &body)
    {
      const std::vector<std::string> groups = split_list(file.raw_value(body.name, "Materials"));
      const std::string where = file.where(body.name, "Materials") + ": ";
      for (const std::string &group : groups)
      {
        if (std::count(groups.begin(), groups.end(), group) > 1)
          throw InputError(where + "the group \"" + group + "\" is listed twice; a group has one material");
        if (group.find('/') != std::string::npos)
          throw InputError(where + "the group \"" + group +
                           "\" has a / in its name, which separates sections; name it otherwise in gmsh");
        const std::string section = joined_path(joined_path(body.name, "Material"), group);
        const bool orthotropic = file.has_section(joined_path(section, "Orthotropic"));
        for (const char *entry : {"Young modulus", "Poisson ratio", "Density"})
          if (file.raw_value(section, entry).empty() && (!orthotropic || entry == std::string("Density")))
            throw InputError(where + "the group \"" + group + "\" has no " + section + "/" + entry +
                             "; of several materials each is given with its Young modulus, Poisson ratio "
                             "and Density");
        body.materials.emplace_back(group, ElasticMaterial());
      }
    }
  } // namespace

  bool Scene::runs(const std::string &analysis) const
  {
    return contains(analyses, analysis);
  }

  bool Scene::any_analysis(bool AnalysisType::*const property) const
  {
    return std::any_of(known_analyses.begin(), known_analyses.end(),
                       [&](const AnalysisType &type) { return type.*property && runs(type.name); });
  }

  Scene read_scene_lists(const ParameterFile &file, const std::vector<AnalysisType> &known_analyses,
                         const std::shared_ptr<const BodyTypes> &body_types)
  {
    Scene scene;
    scene.known_analyses = known_analyses;
    const std::vector<std::string> names = file.list("Bodies");
    if (names.empty())
      throw InputError(file.where("", "Bodies") +
                       ": no body is listed; write for instance \"set Bodies = wheel, rail\"");
    const std::vector<std::string> types = names_of(*body_types);
    std::vector<std::string> reserved = reserved_names;
    for (const AnalysisType &type : known_analyses)
      reserved.push_back(type.section);
    for (const auto &name : names)
    {
      check_body_name(file, name, names, reserved);
      const std::string type = file.raw_value(name, "Type");
      if (type.empty())
        throw InputError(file.where_section(name) +
                         ": the body has no Type; write \"set Type = ...\" with one of " +
                         quoted_list(types));
      if (!contains(types, type))
        throw InputError(file.where(name, "Type") + ": there is no type of body \"" + type + "\"; " +
                         name_suggestion(type, types));
      BodyParameters body(name, type, body_types);
      body.description->read_ahead(file, name + "/" + body.body_type().section);
      if (body.description->has_groups())
        read_materials(file, body);
      scene.bodies.push_back(body);
    }

    scene.contacts = read_contacts(file, names, reserved);
    scene.analyses = file.list("Analyses");
    const std::vector<std::string> known = names_of(known_analyses);
    if (scene.analyses.empty())
      throw InputError(file.where("", "Analyses") +
                       ": no analysis is listed; write \"set Analyses = ...\" with one or more of " +
                       quoted_list(known, "and"));
    for (const auto &analysis : scene.analyses)
    {
      if (!contains(known, analysis))
        throw InputError(file.where("", "Analyses") + ": there is no analysis \"" + analysis + "\"; " +
                         name_suggestion(analysis, known));
      if (std::count(scene.analyses.begin(), scene.analyses.end(), analysis) > 1)
        throw InputError(file.where("", "Analyses") + ": the analysis \"" + analysis +
                         "\" is listed twice; list it once");
    }
    return scene;
  }

  void Scene::declare_parameters(dealii::ParameterHandler &prm)
  {
    bodies_entry = contacts_entry = analyses_entry = "";
    for (const auto &body : bodies)
      bodies_entry += (bodies_entry.empty() ? "" : ", ") + body.name;
    for (const auto &contact : contacts)
      contacts_entry += (contacts_entry.empty() ? "" : ", ") + contact;
    for (const auto &analysis : analyses)
      analyses_entry += (analyses_entry.empty() ? "" : ", ") + analysis;
    std::string help;
    for (const auto &type : known_analyses)
      help += (help.empty() ? "" : "; ") + type.name + ": " + type.help;

    using dealii::Patterns::Anything;
    prm.add_parameter("Title", title, "What this file is about; repeated in the log. Units: none.",
                      Anything());
    prm.add_parameter(
        "Bodies", bodies_entry,
        "Names of the bodies, separated by commas; each has a section of its name. The first is body "
        "1, above (wheel), the second body 2, below (rail). Units: none.",
        Anything());
    prm.add_parameter(
        "Contacts", contacts_entry,
        "Names of several contacts, separated by commas; each has a section of its name with the entries of "
        "Contact and the two Bodies that it joins. Empty: one, of section Contact. Units: none.",
        Anything());
    prm.add_parameter("Analyses", analyses_entry,
                      "What to compute, separated by commas. " + help + ". Units: none.", Anything());
    for (auto &body : bodies)
    {
      prm.enter_subsection(body.name);
      body.declare_parameters(prm);
      prm.leave_subsection();
    }
    for (const AnalysisType &type : known_analyses)
      if (type.make_parameters)
      {
        prm.enter_subsection(type.section);
        (own_parameters[type.name] = type.make_parameters())->declare_parameters(prm);
        prm.leave_subsection();
      }
  }

  void Scene::check() const
  {
    for (const auto &body : bodies)
      body.check(body.name);
    for (const auto &type : known_analyses)
      if (runs(type.name) && type.make_parameters)
        own_parameters.at(type.name)->check(type.section);
    for (const auto &type : known_analyses)
      if (runs(type.name) && type.n_bodies == 2 && bodies.size() != 2 &&
          (contacts.empty() || bodies.size() < 2))
        throw InputError("Bodies lists " + std::to_string(bodies.size()) + " (" + bodies_entry +
                         "), but the analysis \"" + type.name +
                         "\" needs two, body 1 above and body 2 below; list exactly two");
    for (const std::string analysis : {"modes", "frequency response"})
      if (runs(analysis) && std::none_of(bodies.begin(), bodies.end(),
                                         [&](const BodyParameters &body)
                                         {
                                           return body.is_meshed() ||
                                                  (analysis != "modes" &&
                                                   (body.is_green() || body.description->periodic_rail()));
                                         }))
        throw InputError(
            "Analyses asks for " + analysis +
            ", but no body is meshed: half-spaces have no modes, nor have oscillators and analytic "
            "rings (set their Model to beam elements or solid elements); leave \"" +
            analysis + "\" out");
  }
} // namespace vibrocontact
