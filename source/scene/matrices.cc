#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/local_file.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/matrices.h>
#include <vibrocontact/scene/nastran_cards.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  void MatricesParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const std::string formats =
        "Matrix Market (.mtx), CalculiX (.sti, .mas) or else cards DMIG. Units: those of "
        "Length unit, Mass unit, Time unit.";
    prm.add_parameter("Stiffness", stiffness, "File of K. " + formats, FileName());
    prm.add_parameter("Mass", mass, "File of M. " + formats, FileName());
    prm.add_parameter(
        "Damping", damping,
        "File of the viscous damping C, of which each mode takes its own part as damping ratio; "
        "empty: none. " +
            formats,
        FileName());
    prm.add_parameter("Structural damping", structural_damping,
                      "File of the imaginary part of a hysteretic stiffness (Nastran's K4); empty: none. " +
                          formats,
                      FileName());
    prm.add_parameter("Matrix names", matrix_names,
                      "Names of stiffness, mass, damping and structural damping in files of several DMIG. "
                      "Units: none.",
                      List(Anything(), 4, 4, ","));
    prm.add_parameter(
        "Dofs", dofs,
        "Table of what each row of the matrices is: columns node, x, y, z, direction (x, y, z, rx, "
        "ry, rz, or modal without a place); or CalculiX's .dof. Empty: DMIG says so itself. "
        "Units: none.",
        FileName());
    prm.add_parameter(
        "Nodes", nodes,
        "Places of the nodes of .dof and DMIG: deck of CalculiX or Abaqus (.inp), table of node, x, "
        "y, z (.csv), or else Nastran's cards GRID. Units: none.",
        FileName());
    prm.add_parameter(
        "Groups", groups,
        "Table of groups of nodes: columns group, node. Empty: the sets of the deck. Units: none.",
        FileName());
    prm.add_parameter(
        "Recovery", recovery,
        "File (.mtx) of T, u = T q, of a reduced body none of whose coordinates q has a place: the "
        "table of dofs then says what the rows of T are. Empty: coordinates are displacements or "
        "modal. Units: none.",
        FileName());
    prm.add_parameter(
        "Translations", translations,
        "File (.mtx) of three columns, what q does where the whole body moves by one along x, y, z; "
        "beside Recovery. Units: none.",
        FileName());
    prm.add_parameter(
        "Contact group", contact_group,
        "Group of the nodes that can come into contact, on lines along x and y at equal distances; "
        "each is a contact point. Empty: none. Units: none.",
        Anything());
    prm.add_parameter(
        "Contact point", contact_point,
        "Nominal contact point in the files' coordinates; it becomes the origin. Units: unit of the file.",
        List(Double(), 3, 3, ","));
    prm.add_parameter("Held groups", held_groups,
                      "Groups whose nodes are held here, beside what the matrices hold already. Units: none.",
                      List(Anything(), 0, 100, ","));
    prm.add_parameter("Length unit", length_unit, "Length of the files' unit; 0.001 for mm. Units: m.",
                      Double(1e-9, 1e3));
    prm.add_parameter("Mass unit", mass_unit,
                      "Mass of the files' unit; 1000 for t, as beside mm, N and s. Units: kg.",
                      Double(1e-9, 1e9));
    prm.add_parameter("Time unit", time_unit, "Time of the files' unit; 0.001 for ms. Units: s.",
                      Double(1e-9, 1e9));
  }

  bool is_dmig(const std::string &file)
  {
    return !file.empty() && !has_extension(file, ".mtx") && !has_extension(file, ".sti") &&
           !has_extension(file, ".mas");
  }

  void MatricesParameters::check(const std::string &section) const
  {
    const auto refuse = [&](const std::string &text) { throw InputError(section + "/" + text); };
    if (stiffness.empty())
      refuse("Stiffness is empty: give the file of K.");
    if (mass.empty())
      refuse("Mass is empty: give the file of M.");
    if (dofs.empty() && !is_dmig(stiffness))
      refuse(
          "Dofs is empty, but the file of Stiffness does not say what its rows are: give a table of dofs.");
    if (nodes.empty() && (dofs.empty() || has_extension(dofs, ".dof")))
      refuse("Nodes is empty, but " + std::string(dofs.empty() ? "DMIG" : "a .dof") +
             " does not say where nodes are: give a deck, a table of nodes or cards GRID.");
    if (!nodes.empty() && !dofs.empty() && !has_extension(dofs, ".dof"))
      refuse("Nodes is given, but the table of Dofs says where nodes are: leave it out.");
    if (mass == stiffness && has_extension(mass, ".mtx"))
      refuse("Mass and Stiffness are the same file " + mass + ": name the file of each.");
    if (recovery.empty() && !translations.empty())
      refuse(
          "Translations is given without Recovery: coordinates with a place move as they say; leave it out.");
    if (!recovery.empty() && !held_groups.empty())
      refuse("Held groups is given beside Recovery: coordinates without a place cannot be held; leave it out "
             "and "
             "hold the body where it is reduced.");
    if (!contact_group.empty() && std::count(held_groups.begin(), held_groups.end(), contact_group) > 0)
      refuse("Held groups contains the contact group '" + contact_group +
             "': a held node cannot move in contact; take it out of the list.");
    if (!contact_group.empty())
      node_grid(contact_group, group(contact_group, section + "/Contact group"), tables().places, 1);
    for (const std::string &held : held_groups)
      group(held, section + "/Held groups");
    if (tables().dofs.empty() && !dofs.empty())
      refuse("Dofs: " + dofs + " names no dof.");
  }

  const MatricesParameters::Tables &MatricesParameters::tables() const
  {
    std::string names = dofs + "\n" + nodes + "\n" + groups + "\n" + number_text(length_unit);
    for (const double x : contact_point)
      names += "\n" + std::to_string(x);
    if (kept && kept_for == names)
      return *kept;
    auto read = std::make_shared<Tables>();
    bool in_metres = false;
    if (has_extension(dofs, ".dof"))
      read->dofs = read_calculix_dofs(dofs, local_file(dofs, "Dofs"));
    else if (!dofs.empty())
    {
      MatrixDofs table = read_dof_table(dofs, local_file(dofs, "Dofs"));
      read->dofs = std::move(table.dofs);
      read->places = std::move(table.nodes.places);
      in_metres = table.nodes.in_metres;
    }
    if (!nodes.empty())
    {
      const std::string bytes = local_file(nodes, "Nodes");
      if (has_extension(nodes, ".inp"))
      {
        DeckNodes deck = read_deck(nodes, bytes);
        read->places = std::move(deck.places);
        read->groups = std::move(deck.groups);
        read->source_of_groups = nodes;
      }
      else if (has_extension(nodes, ".csv"))
      {
        NodeTable table = read_node_table(nodes, bytes);
        read->places = std::move(table.places);
        in_metres = table.in_metres;
      }
      else
        read->places = read_grid_cards(nodes, bytes);
    }
    if (!groups.empty())
    {
      read->groups = read_group_table(groups, local_file(groups, "Groups"));
      read->source_of_groups = groups;
    }
    for (auto &[node, place] : read->places)
      for (unsigned int d = 0; d < 3; ++d)
        place[d] = (in_metres ? 1. : length_unit) * place[d] - length_unit * contact_point.at(d);
    for (const MatrixDof &dof : read->dofs)
      if (dof.direction != MatrixDof::modal && read->places.count(dof.node) == 0)
        throw InputError(nodes + " does not say where node " + std::to_string(dof.node) +
                         " is, which has a dof in " + dofs + ": add its place.");
    kept = read;
    kept_for = names;
    return *kept;
  }

  const std::vector<unsigned long> &MatricesParameters::group(const std::string &name,
                                                              const std::string &entry) const
  {
    const Tables &read = tables();
    auto found = read.groups.find(name);
    if (found == read.groups.end())
      found = read.groups.find(boost::to_upper_copy(name));
    if (found != read.groups.end())
      return found->second;
    std::vector<std::string> names;
    for (const auto &[present, members] : read.groups)
      names.push_back(present);
    throw InputError(
        entry + " names the group '" + name + "', " +
        (read.source_of_groups.empty() ? std::string("but there is no table of Groups: give one.")
         : names.empty()
             ? "but " + read.source_of_groups + " has no groups: add it."
             : "which " + read.source_of_groups + " does not have: " + name_suggestion(name, names) + "."));
  }

  bool MatricesParameters::add_entries(EntriesRead &entries, const std::string &section,
                                       const BodyUse &use) const
  {
    entries.add(section, "Stiffness, Mass, Held groups, Length unit, Mass unit, Time unit, Recovery");
    entries.add_if(is_dmig(stiffness), "the matrices are DMIG", section, "Matrix names");
    entries.add_if(!is_dmig(stiffness) || !dofs.empty(), "the matrices do not say what their rows are",
                   section, "Dofs");
    entries.add_if(dofs.empty() || has_extension(dofs, ".dof"), "Dofs does not say where nodes are", section,
                   "Nodes");
    entries.add_if(use.contact || !held_groups.empty(), "groups are in contact or held", section, "Groups");
    entries.add_if(use.contact, "the body is in contact", section, "Contact group");
    entries.add_if(use.contact || use.points, "places on it are looked at", section, "Contact point");
    entries.add_if(use.motion && use.loss, "the body moves", section, "Damping, Structural damping");
    entries.add_if(use.motion && !recovery.empty(), "the body moves and Recovery is given", section,
                   "Translations");
    return true;
  }

  void MatricesParameters::print(Log &log) const
  {
    const Tables &read = tables();
    if (!read.dofs.empty())
      log.value(recovery.empty() ? "dofs" : "rows of the recovery matrix",
                static_cast<unsigned int>(read.dofs.size()));
    log.value("nodes with a place", static_cast<unsigned int>(read.places.size()));
    for (const auto &[name, members] : read.groups)
      log.value("nodes of the group " + name, static_cast<unsigned int>(members.size()));
  }

  std::optional<ContactGrid> MatricesParameters::contact_points(const double cell) const
  {
    if (contact_group.empty())
      return {};
    return node_grid(contact_group, group(contact_group, "Contact group"), tables().places, cell).grid;
  }

  bool MatricesParameters::takes_cell() const
  {
    const std::optional<ContactGrid> grid = contact_points(1);
    return grid && (grid->n_x == 1 || grid->n_y == 1);
  }

  namespace
  {
    /// Distinct values, ascending, if they lie at equal distances; nothing otherwise.
    std::optional<std::vector<double>> lines_of(std::vector<double> values, const double tolerance)
    {
      std::sort(values.begin(), values.end());
      std::vector<double> lines;
      for (const double value : values)
        if (lines.empty() || value > lines.back() + tolerance)
          lines.push_back(value);
      const double spacing = lines.size() > 1 ? (lines.back() - lines[0]) / (lines.size() - 1) : 0;
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (std::abs(lines[k] - lines[0] - k * spacing) > 1e-3 * spacing)
          return {};
      return lines;
    }
  } // namespace

  NodeGrid node_grid(const std::string &group, const std::vector<unsigned long> &nodes,
                     const NodePlaces &places, const double cell)
  {
    const std::string what = "The contact group '" + group + "' ";
    if (nodes.empty())
      throw InputError(what + "has no nodes: name some.");
    std::vector<double> x, y, z;
    for (const unsigned long node : nodes)
    {
      const auto found = places.find(node);
      if (found == places.end())
        throw InputError(what + "has node " + std::to_string(node) + ", whose place is not given: add it.");
      x.push_back(found->second[0]);
      y.push_back(found->second[1]);
      z.push_back(found->second[2]);
    }
    const auto extent = [](const std::vector<double> &values) {
      return *std::max_element(values.begin(), values.end()) -
             *std::min_element(values.begin(), values.end());
    };
    const double side = std::max(extent(x), extent(y));
    if (extent(z) > 0.05 * side)
      throw InputError(what + "lies on no plane z = 0: heights of its nodes differ by " +
                       number_text(extent(z)) + " m, more than 5 % of its " + number_text(side) +
                       " m; take nodes of one flat surface.");
    const double lowest =
        *std::min_element(z.begin(), z.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (std::abs(lowest) > 0.05 * (side > 0 ? side : cell))
      throw InputError(what + "lies " + number_text(lowest) +
                       " m above the Contact point along z, the normal of "
                       "the contact: give a Contact point on it.");
    for (const auto &[name, values] : {std::make_pair("x", x), std::make_pair("y", y)})
    {
      const double beside = std::max(*std::min_element(values.begin(), values.end()),
                                     -*std::max_element(values.begin(), values.end()));
      if (side > 0 && beside > side) // a single node has no size
        throw InputError(what + "lies " + number_text(beside) + " m beside the Contact point along " + name +
                         ", further than it is long: give a Contact point on it, in the unit of the nodes.");
    }
    const auto columns = lines_of(x, 1e-4 * side), rows = lines_of(y, 1e-4 * side);
    if (!columns || !rows)
      throw InputError(
          what + "has nodes at unequal distances along " + (columns ? "y" : "x") +
          ": a contact point stands for a cell, and all cells are of one size; take nodes at equal "
          "distances.");
    NodeGrid result;
    ContactGrid &grid = result.grid;
    grid.n_x = columns->size();
    grid.n_y = rows->size();
    if (grid.n_points() != nodes.size())
      throw InputError(what + "has " + std::to_string(nodes.size()) + " nodes on " +
                       std::to_string(grid.n_x) + " lines across x and " + std::to_string(grid.n_y) +
                       " across y: one on each crossing is due, each once.");
    const auto spacing = [&](const std::vector<double> &lines)
    { return lines.size() > 1 ? (lines.back() - lines[0]) / (lines.size() - 1) : cell; };
    grid.spacing_x = spacing(*columns);
    grid.spacing_y = spacing(*rows);
    grid.x_first = columns->front();
    grid.y_first = rows->front();
    grid.of_body = grid.whole_surface = true;
    result.nodes.assign(nodes.size(), 0);
    result.height.assign(nodes.size(), 0.);
    for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const unsigned int i = grid.n_x == 1 ? 0 : std::lround((x[k] - grid.x_first) / grid.spacing_x),
                         j = grid.n_y == 1 ? 0 : std::lround((y[k] - grid.y_first) / grid.spacing_y);
      unsigned long &node = result.nodes[grid.index(i, j)];
      if (node != 0)
        throw InputError(what + "has nodes " + std::to_string(node) + " and " + std::to_string(nodes[k]) +
                         " at one place: name one of them.");
      node = nodes[k];
      result.height[grid.index(i, j)] = z[k];
    }
    return result;
  }
} // namespace vibrocontact
