#pragma once

#include <vibrocontact/scene/body.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// An analysis that the entry Analyses may list.
  struct AnalysisType
  {
    /// name in the file; one line for its reader
    std::string name, help;
    /// bodies that have to be listed; 2: body 1 (wheel, above) and body 2 (rail, below)
    unsigned int n_bodies;
    /// whether the bodies touch on the contact grid; whether they move, in their modes
    bool has_contact = false, has_dynamics = false;
    /// of an analysis that a program adds: its section, and what makes its entries
    std::string section = "";
    std::function<std::shared_ptr<ParameterGroup>()> make_parameters = {};
    /// the section that holds its subsection Sweep; empty: there is none
    std::string sweep_section = "";
    /// whether a swept Contact/Lateral position moves the contact over one reduction of body 1, not anew for each
    bool sweeps_band = false;
  };

  /// What a parameter file describes, before any mesh is made: bodies in the order of the entry Bodies, the
  /// first being body 1 (above), the second body 2 (below), and what to compute.
  struct Scene
  {
    std::string title;
    std::vector<BodyParameters> bodies;
    /// names of the contacts; empty: the only one, of section Contact
    std::vector<std::string> contacts;
    std::vector<std::string> analyses;
    /// that the program has
    std::vector<AnalysisType> known_analyses;
    /// entries of those that bring their own, by name of the analysis
    std::map<std::string, std::shared_ptr<ParameterGroup>> own_parameters;

    bool runs(const std::string &analysis) const;
    /// Whether one of the analyses has it: AnalysisType::has_contact, has_dynamics.
    bool any_analysis(bool AnalysisType::*property) const;

    /// Title, Bodies, Contacts, Analyses and the subsections of the bodies.
    void declare_parameters(dealii::ParameterHandler &prm);
    /// Combinations, after parsing.
    void check() const;

    /// as in the file; bodies and analyses above are what was made of them
    std::string bodies_entry, contacts_entry, analyses_entry;
  };

  /// First pass over a file: only the lists of bodies, contacts and analyses and the bodies' types, which decide what
  /// sections there are. @throws InputError if a list is empty, names something unknown or a section is
  /// missing
  Scene read_scene_lists(const ParameterFile &file, const std::vector<AnalysisType> &known_analyses,
                         const std::shared_ptr<const BodyTypes> &body_types);
} // namespace vibrocontact
