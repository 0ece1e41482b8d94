#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/contact/body_places.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/output/scene_picture.h>
#include <vibrocontact/output/scene_summary.h>
#include <vibrocontact/reduction/damped_wheel.h>
#include <vibrocontact/reduction/reduction_cost.h>
#include <vibrocontact/run/check_loading.h>
#include <vibrocontact/run/prepare_bodies.h>
#include <vibrocontact/scene/mesh_compactness.h>
#include <vibrocontact/waveguide/rail_section.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// The lateral position that matters to body k: that of the contact on body 1, a wheel's in any place.
    double lateral_position(const Parameters &parameters, const unsigned int k)
    {
      return k == 0 || parameters.scene.bodies[k].description->is_wheel()
                 ? parameters.contact().lateral_position
                 : 0.;
    }
  } // namespace

  std::string reduction_key(const Parameters &parameters, const DeclaredParameters &declared,
                            const unsigned int k)
  {
    return body_key(declared, parameters.scene.bodies[k].name, lateral_position(parameters, k),
                    parameters.places(k)) +
           (parameters.is_above(k) ? "above" : "below");
  }

  std::unique_ptr<MeshedBody> meshed_body(const Parameters &parameters, const std::string &key,
                                          const unsigned int k)
  {
    const BodyParameters &body = parameters.scene.bodies[k];
    if (!body.is_meshed())
      return nullptr;
    const auto solver = parameters.stiffness_solvers.find(body.name);
    return std::make_unique<MeshedBody>(
        body, parameters.modes.at(body.name),
        solver == parameters.stiffness_solvers.end() ? StiffnessSolverParameters() : solver->second,
        parameters.is_above(k), lateral_position(parameters, k), parameters.places(k), key,
        parameters.output.cache_directory, MPI_COMM_WORLD);
  }

  std::unique_ptr<TrackBody> track_body(const Parameters &parameters, const std::string &key,
                                        const unsigned int k)
  {
    const BodyParameters &body = parameters.scene.bodies[k];
    const std::vector<ContactPlace> places = parameters.places(k);
    if (!body.is_periodic_rail() || places.empty())
      return nullptr;
    return std::make_unique<TrackBody>(body, places.front().grid, key, parameters.output.cache_directory,
                                       MPI_COMM_WORLD);
  }

  MeshedBodies meshed_bodies(const Parameters &parameters, const DeclaredParameters &declared)
  {
    MeshedBodies bodies;
    for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
    {
      const std::string key = reduction_key(parameters, declared, k);
      bodies.push_back(meshed_body(parameters, key, k));
      bodies.tracks.push_back(track_body(parameters, key, k));
    }
    return bodies;
  }

  void complete_reduction(ReducedBody &body, const BodyParameters &parameters, const ModeParameters &modes,
                          const bool with_dampers)
  {
    const RevolvedShapes *const section = body.section.get();
    if (section && parameters.material_loss_factor() > 0)
      add_loss(body, loss_of_parts(*section, loss_of_materials(*section, parameters)));
    body.damping_ratio = modes.scaled(body.damping_ratio, body.omega);
    if (body.loss.m() > 0)
      body.loss *= modes.damping_factor;
    body.relaxation = modes.stiffness_damping;
    if (parameters.rotation.has_coriolis() && body.flow)
    {
      static_cast<BodyInContact &>(body) = rolling_modes(body, *body.flow, parameters.rotation.speed);
      body.flow = nullptr;
      if (body.loss.m() > 0)
        run_log().line("The loss of " + parameters.name +
                       " couples modes; beside Coriolis forces each mode takes its own part alone");
      body.loss = DenseMatrix();
      body.n_rigid_modes = 0;
      return;
    }
    const std::vector<WheelDamper> *const dampers = parameters.description->wheel_dampers();
    if (!with_dampers || !section || !dampers || dampers->empty())
      return;
    const std::string path = parameters.name + "/" + parameters.body_type().section + "/Damper";
    const std::vector<double> layers = loss_of_layers(*section, *dampers, path);
    if (std::any_of(layers.begin(), layers.end(), [](const double loss) { return loss > 0; }))
      add_loss(body, loss_of_parts(*section, layers));
    body = with_attached(std::move(body), attached_masses(*section, *dampers, path));
  }

  ReducedBody free_modes(MeshedBody &body, const BodyParameters &parameters)
  {
    const ModalReduction &modal = body.reduction.modal();
    ReducedBody result;
    result.name = parameters.name;
    result.n_rigid_modes = modal.n_rigid_modes;
    result.omega = modal.omega;
    result.damping_ratio = modal.damping_ratio;
    result.labels = modal.labels;
    result.modal_load = modal.load;
    result.participation = modal.participation;
    result.loss = modal.loss;
    result.trace.reinit(0, modal.omega.size());
    result.section = body.reduction.revolved_shapes();
    if (parameters.rotation.has_coriolis())
      result.flow = body.reduction.flow();
    complete_reduction(result, parameters, body.reduction.request().modes);
    return result;
  }

  SurfaceShapes shapes_of_modes(MeshedBody &body, const BodyParameters &parameters)
  {
    const SurfaceShapes &shapes = body.reduction.surface_shapes();
    const std::vector<WheelDamper> *const dampers = parameters.description->wheel_dampers();
    if (!dampers || dampers->empty())
      return shapes;
    const ReducedBody modes = free_modes(body, parameters);
    return mixed_shapes(shapes, modes.mixing, modes.omega);
  }

  void reduce_bodies(const MeshedBodies &bodies, const bool with_modes)
  {
    for (const auto &body : bodies)
      if (body)
      {
        body->reduction.statics();
        // Coriolis forces have no part in statics
        if ((with_modes || body->parameters.rolls()) && body->reduction.request().modes.any())
          body->reduction.modal();
      }
    for (const auto &track : bodies.tracks)
      if (track)
        with_modes ? track->moving() : track->at_rest();
  }

  namespace
  {
    bool wants_modes(const Parameters &parameters, const MeshedBody &body)
    {
      return (parameters.scene.runs("modes") || parameters.needs_modes() || body.parameters.rolls()) &&
             body.reduction.request().modes.any();
    }

    /// of modes up to a frequency: how many there are is told by the factorised stiffness only
    constexpr double supposed_modes = 100;

    /// Of a solid body whose mesh is made, by the solver that its entry asks for: an automatic choice is direct unless
    /// that does not fit the memory beside what other bodies keep [byte] and the iterative one can do what is asked.
    ReductionCost cost_of(const Parameters &parameters, MeshedBody &body, const double kept = 0)
    {
      const ReductionRequest &request = body.reduction.request();
      ReductionSize size;
      size.n_dofs = body.elastic_body().dof_handler.n_dofs();
      size.compactness = mesh_compactness(*body.elastic_body().mesh.triangulation);
      size.n_rows = parameters.has_contact() ? 3. * parameters.placed_contacts().n_points() : 0.;
      if (wants_modes(parameters, body))
        size.n_modes = request.modes.count > 0 ? request.modes.count : supposed_modes;
      size.counts_first = request.modes.count == 0;
      size.prestressed = body.parameters.is_prestressed() && body.parameters.has_load();
      const ReductionCost direct = reduction_cost(size),
                          iterative = reduction_cost(size, StiffnessSolver::iterative);
      if (const auto named = request.solver.named())
        return named == StiffnessSolver::direct ? direct : iterative;
      const double n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const bool fits = memory_shortage("", (kept + direct.peak) / n_ranks, MPI_COMM_WORLD).empty(),
                 by_frequency = size.n_modes > 0 && size.counts_first;
      return fits || by_frequency ? direct : iterative;
    }

    /// Each body keeps its factors while the next one is reduced.
    void check_memory(const double peak)
    {
      // a guess from the size alone; what MUMPS itself says is looked at before each factorisation
      constexpr double certain = 0.7;
      if (peak == 0)
        return;
      const double share = peak / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const std::string shortage =
          memory_shortage("The reduction of the bodies", certain * share, MPI_COMM_WORLD);
      if (!shortage.empty())
        throw MachineError(shortage + ": " + ways_to_less_memory + ".");
      const MemoryLeft left = memory_left();
      const Log::Part part("Memory");
      run_log().value("memory of the reductions", "about " + bytes_text(peak) + " at the peak; " +
                                                      left.limit + " leaves " + bytes_text(left.bytes));
    }

    void print_cost(const ReductionCost &cost)
    {
      for (const ReductionStage &stage : cost.stages)
        run_log().value("  " + stage.name + ", when not cached",
                        "about " + time_text(std::ceil(stage.seconds)) + ", " + bytes_text(stage.bytes));
    }
  } // namespace

  namespace
  {
    /// What the periodic rails of a scene cost: in their contact and in frequency responses.
    void print_tracks(const Parameters &parameters, const MeshedBodies &bodies)
    {
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
      {
        const BodyParameters &body = parameters.scene.bodies[k];
        const RailParameters *const rail = body.description->periodic_rail();
        if (!rail)
          continue;
        const unsigned int n_dofs = RailSection(body, *rail).elements.n_dofs();
        run_log().value("dofs of the section of " + body.name, n_dofs);
        const TrackBody *const track = bodies.tracks[k].get();
        const FrequencyResponseParameters &response = parameters.frequency_response;
        const bool responds = parameters.scene.runs("frequency response") && response.asks_for(body.name);
        print_cost(track_cost(n_dofs, track ? 3 * track->contact_grid().n_points() : 0,
                              track && parameters.needs_modes() ? TrackBody::n_frequencies : 0,
                              responds ? response.frequencies().size() + response.n_refined : 0));
      }
    }
  } // namespace

  namespace
  {
    /// What reduction/damped_wheel.h refuses, on a section without modes.
    void check_places_of_dampers(const BodyParameters &body, const RevolvedSection &elements)
    {
      const std::vector<WheelDamper> *const dampers = body.description->wheel_dampers();
      if (!dampers || dampers->empty())
        return;
      const RevolvedShapes section = shapes_without_modes(elements);
      const std::string path = body.name + "/" + body.body_type().section + "/Damper";
      attached_masses(section, *dampers, path);
      loss_of_layers(section, *dampers, path);
    }
  } // namespace

  void check_meshes(const Parameters &parameters, const MeshedBodies &bodies, const bool all)
  {
    for (const auto &track : bodies.tracks)
      if (track)
        track->check();
    double kept = 0, peak = 0;
    for (const auto &body : bodies)
      if (body)
      {
        const bool with_modes = wants_modes(parameters, *body);
        // a mesh that is to be written has to be made
        const bool wanted = all || body->parameters.description->writes_mesh();
        const bool cached = body->reduction.is_cached(parameters.has_contact(), with_modes);
        if (cached && !wanted)
          continue;
        if (body->parameters.is_revolved())
          // its section and contact are checked
          check_places_of_dampers(body->parameters, body->reduction.revolved().elements());
        const ElementBody *const elements = body->parameters.description->elements();
        if (elements && elements->is_assembled_first())
          body->reduction.system();
        if (!body->parameters.is_solid())
          continue;
        body->elastic_body();
        body->check_contact();
        if (cached)
          continue;
        const ReductionCost cost = cost_of(parameters, *body, kept);
        body->reduction.choose(cost.solver);
        peak = std::max(peak, kept + cost.peak);
        kept += cost.kept;
      }
    check_memory(peak);
  }

  void print_scene(const Parameters &parameters, const MeshedBodies &bodies, const ContactGrid &grid,
                   const std::string &picture_folder)
  {
    const ContactGrid *const contact_grid = parameters.has_contact() ? &grid : nullptr;
    std::vector<DrawnBody> drawn;
    for (unsigned int k = 0; k < bodies.size(); ++k)
    {
      const bool solid = bodies[k] && bodies[k]->parameters.is_solid();
      drawn.push_back({&parameters.scene.bodies[k], solid ? &bodies[k]->elastic_body() : nullptr});
      print_body(*drawn.back().parameters, drawn.back().solid);
      if (solid)
      {
        const ReductionCost cost = cost_of(parameters, *bodies[k]);
        run_log().value("solver of its stiffness", name_of(cost.solver));
        print_cost(cost);
      }
      if (bodies[k] && bodies[k]->parameters.is_revolved())
      {
        const RevolvedReduction &waves = bodies[k]->reduction.revolved();
        const SurfaceShapes surface = waves.surface();
        drawn.back().points = surface.points;
        drawn.back().quads = surface.quads;
        run_log().value("dofs of its section", waves.n_section_dofs());
        print_cost(
            revolved_cost(waves.n_section_dofs(), waves.n_waves(), wants_modes(parameters, *bodies[k])));
      }
    }
    print_tracks(parameters, bodies);
    for (const PlacedContact &contact : parameters.placed_contacts().all)
    {
      if (!contact.name.empty())
        run_log().value("contact", contact.name);
      if (contact_grid)
        print_contact_grid(contact.grid);
    }
    if (parameters.goes_through_loading())
      print_load_history(parameters);
    if (parameters.scene.runs("stability"))
      run_log().value("loss of the bodies in stability", parameters.stability.loss);
    if (!picture_folder.empty())
    {
      run_log().block("Picture of the scene");
      const PlacedContacts contacts = parameters.placed_contacts();
      const auto places = places_of_bodies(contacts, drawn.size());
      for (unsigned int k = 0; k < drawn.size(); ++k)
        drawn[k].place = places[k];
      draw_scene(drawn, contact_grid ? &contacts : nullptr, picture_folder);
    }
    run_log().end_block();
    run_log().line("");
    run_log().line("The file is valid; nothing was run.");
  }

  nlohmann::ordered_json reductions_json(const MeshedBodies &bodies)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    const std::vector<double> memory = peak_memory_of_ranks();
    for (const auto &body : bodies)
      if (body)
      {
        nlohmann::ordered_json stages = nlohmann::ordered_json::object(),
                               ranks = nlohmann::ordered_json::array();
        for (const auto &[stage, seconds] : body->reduction.stages())
          stages[stage] = stages.value(stage, 0.) + seconds;
        const ElasticBody<3> *const made = body->made();
        const auto dofs = dealii::Utilities::MPI::all_gather(
            run_communicator(),
            made ? static_cast<unsigned long long>(made->locally_owned.n_elements()) : 0ull);
        for (unsigned int r = 0; r < dofs.size() && made; ++r)
          ranks.push_back({{"dofs", dofs[r]}, {"peak_memory_MB", memory[r]}});
        result[body->parameters.name] = {{"stages_s", stages}, {"ranks", ranks}};
        if (body->parameters.is_revolved())
          result[body->parameters.name]["rotation"] = body->parameters.rolls();
      }
    for (const auto &track : bodies.tracks)
      if (track && !track->fit_json().is_null())
        result[track->parameters.name] = {{"fit", track->fit_json()}};
    return result;
  }

  void write_track_fits(const MeshedBodies &bodies, const std::string &folder)
  {
    for (const auto &track : bodies.tracks)
      if (track)
        for (const auto &[name, table] : track->fit_tables())
          on_first_rank([&, &name = name, &table = table] { table.write(folder + "/" + name + ".csv"); });
  }
} // namespace vibrocontact
