#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/input_files.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/contact_operator.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/trace_assembly.h>
#include <vibrocontact/reduction/prestressed_body.h>
#include <vibrocontact/run/meshed_body.h>

#include <limits>
#include <sstream>

namespace vibrocontact
{
  std::string body_key(const DeclaredParameters &parameters, const std::string &body,
                       const double lateral_position, const std::vector<ContactPlace> &places)
  {
    std::ostringstream key;
    key.precision(17);
    const DeclaredParameters::Entry *const model = parameters.find(body + "/Wheel", "Model");
    const bool by_harmonics = model && model->value == "harmonics";
    const DeclaredParameters::Entry *const web = parameters.find(body + "/Wheel", "Web thickness change");
    const bool as_drawn = web && std::stod(web->value) == 0;
    for (const DeclaredParameters::Entry &entry : parameters.entries)
    {
      const bool own = entry.section == body || entry.section.rfind(body + "/", 0) == 0;
      if (!own || entry.section == body + "/Modes" || entry.section == body + "/Solver" ||
          (entry.name == "Materials" && entry.value.empty()))
        continue;
      if (as_drawn && (entry.name == "Web thickness change" || entry.name == "Web radii"))
        continue;
      // as those of a body at rest they change nothing, and are younger than many a cache
      constexpr const char *orthotropic = "/Orthotropic";
      const std::size_t end = std::string(orthotropic).size();
      const bool is_young =
          entry.section == body + "/Mesh/CAD" || entry.section == body + "/Rotation" ||
          entry.name.rfind("Pressure", 0) == 0 || entry.name == "Prestress" || entry.name == "Masses" ||
          entry.name == "Foundation damping" ||
          (entry.section.size() > end && entry.section.substr(entry.section.size() - end) == orthotropic);
      if (is_young && entry.value == entry.default_value)
        continue;
      // what turns is made of the modes at rest
      if (entry.section == body + "/Wheel" && entry.name == "Rotation")
        continue;
      // poles are fitted to what is kept
      if (entry.section == body + "/Rail" && entry.name == "Pole pairs")
        continue;
      // of a wheel by harmonics losses come in after its reduction, as dampers do (reduction/damped_wheel.h)
      const bool is_damper = entry.section.rfind(body + "/Wheel/Damper", 0) == 0 || entry.name == "Dampers";
      const bool is_loss = entry.section.rfind(body + "/Material", 0) == 0 && entry.name == "Loss factor";
      if (by_harmonics && (is_damper || is_loss))
        continue;
      // a file that is written changes nothing of the body
      const std::string value = entry.name == "Write mesh" ? "" : entry.value;
      key << entry.section.substr(body.size()) << "/" << entry.name << "=" << value;
      if (names_input_file(entry))
        key << ", " << fingerprint(value);
      key << "\n";
    }
    // its compliance has had more than a flat half-space's short waves since then
    if (by_harmonics)
      key << "short waves of a round tread\n";
    // sections that come with the program and are named by no entry
    for (const char *name :
         {"wheel_section.msh", "wheel_outline.txt", "rail_60e1_section.msh", "rail_60e1_outline.txt"})
      key << name << " " << fingerprint(mesh_directory() + "/" + name) << "\n";
    // a wheel lies as high as its tread is there, with or without contact
    key << "lateral position=" << lateral_position << "\n";
    for (const ContactPlace &place : places)
    {
      const ContactGrid &grid = place.grid;
      key << "grid=" << grid.n_x << " x " << grid.n_y << " from " << grid.x_first << ", " << grid.y_first
          << " by " << grid.spacing_x << ", " << grid.spacing_y << ", traction " << int(grid.traction)
          << "\n";
      if (places.size() == 1 && place.frame.is_usual())
        continue;
      key << (place.above ? "above" : "below") << " at";
      for (const double value : place.frame.origin)
        key << " " << value;
      for (const auto &axis : place.frame.axes)
        for (const double value : axis)
          key << " " << value;
      key << "\n";
    }
    return key.str();
  }

  double rim_radius(const BodyParameters &body, const ModeParameters &modes)
  {
    if (modes.rim_radius > 0)
      return modes.rim_radius;
    return WheelFrame().rim_radius * body.description->size_over_section();
  }

  namespace
  {
    ReductionRequest request(const BodyParameters &parameters, const ModeParameters &modes,
                             const StiffnessSolverParameters &solver, const double lateral_position,
                             const std::string &key, const std::string &cache_directory)
    {
      ReductionRequest request;
      request.body = parameters.name;
      request.key = key;
      request.modes = modes;
      request.solver = solver;
      request.cache_directory = cache_directory;
      request.flows = parameters.has_complex_modes();
      if (const auto height = parameters.axle_height(lateral_position))
        request.wheel = WheelFrame{*height, rim_radius(parameters, modes)};
      return request;
    }
  } // namespace

  MeshedBody::MeshedBody(const BodyParameters &parameters, const ModeParameters &modes,
                         const StiffnessSolverParameters &solver, const bool above,
                         const double lateral_position, const std::vector<ContactPlace> &places,
                         const std::string &key, const std::string &cache_directory,
                         const MPI_Comm communicator)
      : parameters(parameters), above(above), lateral_position(lateral_position), places(places),
        communicator(communicator),
        reduction(request(parameters, modes, solver, lateral_position, key, cache_directory),
                  {[this]() { return assemble(); },
                   parameters.is_revolved() ? BodyReduction::Revolve([this]() { return revolve(); })
                                            : BodyReduction::Revolve()},
                  communicator)
  {
  }

  std::unique_ptr<SecondOrderSystem> MeshedBody::assemble()
  {
    const ContactGrid *const pointer = places.empty() ? nullptr : &places.front().grid;
    if (const ElementBody *const elements = parameters.description->elements())
    {
      auto system = elements->assemble(parameters, above, pointer, communicator);
      if (pointer && parameters.description->lies_on_half_space())
        system->local_compliance =
            half_space_compliance(*pointer, HalfSpacePair({std::numeric_limits<double>::infinity(), 0.},
                                                          half_space_material(parameters)));
      if (!places.empty())
        system->trace = contacts_of(*elements, *system);
      return system;
    }
    const double n_dofs = elastic_body().dof_handler.n_dofs();
    // 20 us per dof on one rank
    const Progress progress(parameters.name + ": assembly of " + number_text(n_dofs) + " dofs", 1,
                            20e-6 * n_dofs / dealii::Utilities::MPI::n_mpi_processes(communicator));
    std::unique_ptr<SecondOrderSystem> system = assemble_body(elastic_body());
    double attached = 0;
    for (const PointMass &mass : elastic_body().model.masses)
      attached += mass.mass;
    if (attached > 0)
      run_log().line(parameters.name + ": a mass of " + number_text(system->total_mass) + " kg, " +
                     number_text(attached) + " kg of it coupled to groups");
    if (parameters.is_prestressed())
      prestress(elastic_body(), reduction.solver(), *system);
    if (!places.empty())
    {
      check_contact();
      system->trace = std::move(*trace);
      trace.reset();
    }
    return system;
  }

  std::unique_ptr<RevolvedReduction> MeshedBody::revolve()
  {
    const ContactGrid *const grid = places.empty() ? nullptr : &places.front().grid;
    if (grid)
      check_side(places.front().above, false);
    ElasticModel<3> model = elastic_model(parameters);
    revolved_mesh = parameters.description->revolved()->make_section(
        {parameters.name, lateral_position, places, grid, group_names(parameters), communicator});
    const RevolvedMesh &mesh = *revolved_mesh;
    model.held = {mesh.held};
    model.gravity[2] = -parameters.loads.gravity;
    std::optional<RevolvedReduction::Contact> contact;
    if (grid)
    {
      const ElasticMaterial &material = model.material_of(mesh.contact_material);
      contact = RevolvedReduction::Contact{*grid,
                                           mesh.tread,
                                           {material.young_modulus, material.poisson_ratio},
                                           mesh.n_harmonics,
                                           mesh.surface_height};
    }
    return std::make_unique<RevolvedReduction>(
        std::make_unique<RevolvedSection>(parameters.name, mesh.triangulation, model, mesh.degree,
                                          mesh.displacement),
        parameters.name, mesh.radius, lateral_position, contact, communicator);
  }

  const RevolvedMesh &MeshedBody::section()
  {
    reduction.revolved();
    return *revolved_mesh;
  }

  void MeshedBody::check_contact()
  {
    if (places.empty() || trace)
      return;
    std::vector<ContactTrace> traces;
    for (const ContactPlace &place : places)
    {
      traces.push_back(make_contact_trace(elastic_body(), place.grid, place.frame));
      check_side(place.above, traces.back().faces_up);
    }
    trace = joined(traces);
  }

  ContactTrace MeshedBody::contacts_of(const ElementBody &elements, const SecondOrderSystem &system) const
  {
    std::vector<ContactTrace> traces;
    for (const ContactPlace &place : places)
    {
      traces.push_back(system.trace);
      if (place.frame.origin[2] != 0)
        elements.move_contact(system, traces.back(), place.frame.origin[2]);
    }
    return joined(traces);
  }

  void MeshedBody::check_side(const bool above, const bool faces_up) const
  {
    if (faces_up == !above)
      return;
    const std::string &name = parameters.name, is = above ? "body 1, above" : "body 2, below",
                      direction = faces_up ? "up" : "down";
    throw InputError(parameters.description->contact_surface(name) + " points " + direction + ", but " +
                     name + " is " + is +
                     " the plane of contact: " + parameters.description->way_to_turn(name, above) +
                     " or list the bodies the other way round.");
  }

  const ElasticBody<3> &MeshedBody::elastic_body()
  {
    if (!body)
    {
      const Log::Part part("Finite elements of " + parameters.name);
      const Progress progress(parameters.name + ": mesh", 1);
      body = make_elastic_body(parameters, lateral_position, places, communicator,
                               reduction.request().cache_directory);
      run_log().value("cells", static_cast<unsigned int>(body->mesh.triangulation->n_global_active_cells()));
      run_log().value("dofs", static_cast<unsigned int>(body->dof_handler.n_dofs()));
    }
    return *body;
  }
} // namespace vibrocontact
