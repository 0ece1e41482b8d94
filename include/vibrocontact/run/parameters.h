#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response.h>
#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_parameters.h>
#include <vibrocontact/analyses/modal_convolution/method_comparison.h>
#include <vibrocontact/analyses/periodic/periodic.h>
#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/coupled_bodies/loading_parameters.h>
#include <vibrocontact/marching/signal_parameters.h>
#include <vibrocontact/marching/transient_parameters.h>
#include <vibrocontact/output/output_parameters.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/reduction/stiffness_solver.h>
#include <vibrocontact/run/entry_tables.h>
#include <vibrocontact/run/parameter_sweep.h>
#include <vibrocontact/scene/scene.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Everything that a parameter file sets. Sections of analyses that are not listed may stand in the file;
  /// their combinations are checked only if the analysis runs.
  struct Parameters
  {
    Scene scene;
    OutputParameters output;
    ContactSections contacts;
    ContactSolverParameters contact_solver;
    RollingParameters rolling;
    /// whether the file or an option gives Rolling/Speed
    bool is_speed_given = false;
    LoadingParameters loading;
    TransientParameters transient;
    SignalParameters signals;
    LimitCycleParameters limit_cycle;
    StabilityParameters stability;
    FrequencyResponseParameters frequency_response;
    RoadParameters road;
    ModalConvolutionParameters modal_convolution;
    ComparisonParameters comparison;
    PeriodicParameters periodic;
    /// of the meshed bodies, by name
    std::map<std::string, ModeParameters> modes;
    /// of solid bodies, by their names
    std::map<std::string, StiffnessSolverParameters> stiffness_solvers;
    IdentificationParameters identification;
    /// of the analyses that take a Sweep, by name
    std::map<std::string, ParameterSweep> sweeps;
    /// what entries choose from
    std::shared_ptr<const EntryTables> tables;

    /// Before anything is read.
    void take(const std::shared_ptr<const EntryTables> &tables);
    /// The first pass over a file: the lists of the scene, by which everything is declared.
    void read_lists(const ParameterFile &file, dealii::ParameterHandler &prm,
                    const std::vector<AnalysisType> &known_analyses);
    /// After the lists of the scene are filled.
    void declare(dealii::ParameterHandler &prm);
    /// Bodies, contact and analyses against each other (run/check_parameters.cc). @throws InputError
    void check() const;
    /// Looks for bodies that touch with a flat face which ends within reach of the contact grid (contact_grid()
    /// then ends with it), and refuses grids that such a contact would fill for certain without ending there.
    void find_flat_faces();
    void find_flat_faces(unsigned int contact_number);
    /// Section Contact, or the first of several: what analyses of one contact take.
    const ContactParameters &contact() const { return contacts.first(); }
    /// Whether a contact grid is needed.
    bool has_contact() const
    {
      return (scene.runs("periodic") && has_periodic_grid()) ||
             scene.any_analysis(&AnalysisType::has_contact);
    }
    /// Whether a periodic motion has the points of the contacts' grids, no Periodic/Contact points.
    bool has_periodic_grid() const
    {
      if (!scene.contacts.empty())
        return true;
      for (const unsigned int b : vibrating_bodies())
        if (scene.bodies[b].is_meshed() && periodic.contact_points_on(b).empty())
          return true;
      return false;
    }
    /// Places in the entry Bodies of those that a periodic motion moves: body 1, and what it touches unless that is a rigid
    /// stop.
    std::vector<unsigned int> vibrating_bodies() const
    {
      std::vector<unsigned int> result = {0};
      const std::size_t n =
          scene.contacts.empty() ? std::min<std::size_t>(2, scene.bodies.size()) : scene.bodies.size();
      for (unsigned int b = 1; b < n; ++b)
        if (!scene.bodies[b].description->is_rigid())
          result.push_back(b);
      return result;
    }
    /// Whether the bodies move.
    bool has_dynamics() const { return scene.any_analysis(&AnalysisType::has_dynamics); }
    /// Whether a contact takes another local flexibility than the elements'.
    bool replaces_flexibility() const
    {
      return std::any_of(contacts.all.begin(), contacts.all.end(),
                         [](const ContactParameters &one) { return one.replaces_flexibility(); });
    }
    /// Modes/Stiffness damping of a body [s]; 0 of one without elements.
    double stiffness_damping(const BodyParameters &body) const
    {
      return body.is_meshed() ? modes.at(body.name).stiffness_damping : 0.;
    }
    /// Largest friction coefficient of the contacts [-].
    double largest_friction() const
    {
      double largest = 0;
      for (const ContactParameters &one : contacts.all)
        largest = std::max(largest, one.friction);
      return largest;
    }
    /// Whether the contact needs the modes of the bodies.
    bool needs_modes() const
    {
      return has_dynamics() || scene.runs("periodic") || (has_contact() && replaces_flexibility());
    }
    /// RollingParameters::hub as it applies to the bodies of this scene.
    std::string hub() const { return has_hub() ? rolling.hub : "none"; }
    /// the history of section Loading, by itself or before a march
    bool goes_through_loading() const
    {
      return scene.runs("quasi-static loading") ||
             (scene.runs("transient") && transient.starts_from_loading());
    }
    /// by the steps of section Transient
    bool goes_through_time() const { return scene.runs("transient") || scene.runs("limit cycle"); }
    /// body 1 is no half-space
    bool has_hub() const { return scene.bodies[0].vibrates() || scene.bodies[0].description->is_rigid(); }
    /// Whether some body touches in one point only.
    bool touches_in_a_point() const;
    /// Whether data are identified: by the analysis, or for a body.
    bool has_identification() const;
    /// The normal law of periodic motion in contact k, and those of all points.
    std::shared_ptr<const NormalLaw> periodic_law(unsigned int k) const;
    PointLaws<NormalLaw> periodic_laws() const;
    /// The grid of contact k, or one point if a body has no more.
    ContactGrid contact_grid(unsigned int k = 0) const;
    /// All of them with their bodies and frames.
    PlacedContacts placed_contacts() const;
    /// Places in the entry Bodies of the two bodies of contact k.
    std::pair<unsigned int, unsigned int> bodies_of_contact(unsigned int k) const;
    /// The sweep of a listed analysis that moves the contact over a band of body 1 (AnalysisType::sweeps_band); null: none.
    const ParameterSweep *lateral_sweep() const;
    /// The lateral positions of lateral_sweep() [m]: those whose contact point lies on the tread of a
    /// wheel, at least two rows of points from its ends, and those left out. Empty if the position is not
    /// swept.
    struct LateralPositions
    {
      std::vector<double> kept, left_out;
    };
    LateralPositions lateral_positions() const;
    /// The contact grid in a lateral position of the sweep: without the rows that leave the tread.
    ContactGrid contact_grid_at(double lateral_position) const;
    /// The position nearest to that of the file, on its side towards +y, from which a lateral position of the sweep lies whole
    /// grid spacings away: a body of revolution is reduced on a band for each. For other bodies always that of the file.
    double position_on_grid(double lateral_position) const;
    /// The grid on which body k (0 or 1) is reduced: that of the contact, or for body 1 the band of its
    /// windows if the lateral position is swept.
    ContactGrid body_grid(unsigned int k) const;
    /// Where body k has contacts; empty if no analysis has one.
    std::vector<ContactPlace> places(unsigned int k) const;
    /// Whether it is the first body of its first contact.
    bool is_above(unsigned int k) const;
  };

  /// Both passes over a file and all checks that need no mesh. Says in the log which alternative an option
  /// replaced. The handler refers to the members of @p parameters afterwards.
  /// @param known_analyses, tables what the program has
  /// @return all entries with their values
  /// @throws InputError with file, line, section and entry
  DeclaredParameters read_parameters(ParameterFile &file, dealii::ParameterHandler &prm,
                                     Parameters &parameters, const std::vector<AnalysisType> &known_analyses,
                                     const std::shared_ptr<const EntryTables> &tables);

  /// Every parameter as a valid file: a wheel on a rail; sections of the other kinds of bodies as comments.
  std::string all_parameters(const std::vector<AnalysisType> &known_analyses,
                             const std::shared_ptr<const EntryTables> &tables);
} // namespace vibrocontact
