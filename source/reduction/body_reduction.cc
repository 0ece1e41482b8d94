#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/attachment_inertia.h>
#include <vibrocontact/reduction/body_reduction.h>

#include <deal.II/base/timer.h>

namespace vibrocontact
{
  BodyReduction::BodyReduction(const ReductionRequest &request, const Maker &maker, MPI_Comm communicator)
      : asked(request), maker(maker), communicator(communicator),
        cache(request.cache_directory, communicator),
        chosen(request.solver.named().value_or(StiffnessSolver::direct))
  {
  }

  const SecondOrderSystem &BodyReduction::system()
  {
    if (maker.revolve)
      throw InputError("Body " + asked.body +
                       " is solved by harmonics around its axle, so that it has no elements "
                       "of the whole body, which are asked for here: set its Model to solid.");
    if (!assembled)
    {
      const Log::Part part(heading());
      const Progress progress(asked.body + ": mesh and assembly", 1);
      dealii::Timer timer;
      assembled = maker.assemble();
      timings.emplace_back("mesh and assembly", timer.wall_time());
      run_log().line(asked.body + ": mesh and assembly of " + std::to_string(assembled->stiffness.m()) +
                     " dofs: " + time_text(timer.wall_time()));
    }
    return *assembled;
  }

  const RevolvedReduction &BodyReduction::revolved()
  {
    if (!by_harmonics)
    {
      dealii::Timer timer;
      by_harmonics = maker.revolve();
      timings.emplace_back("section", timer.wall_time());
    }
    return *by_harmonics;
  }

  Flexibility &BodyReduction::flexibility()
  {
    if (!factorised)
    {
      const Log::Part part(heading());
      const SecondOrderSystem &matrices = system();
      dealii::Timer timer;
      factorised = std::make_unique<Flexibility>(matrices, chosen);
      timings.emplace_back("factorisation", timer.wall_time());
    }
    return *factorised;
  }

  bool BodyReduction::is_cached(const bool with_statics, const bool with_modes)
  {
    const Log::Part part(heading());
    if (with_statics && !static_part && (static_part = cache.load_static(asked.body, asked.key)))
      run_log().line(asked.body + ": contact compliance found in the cache");
    if (with_modes && !modal_part)
      load_modes();
    return (!with_statics || static_part) && (!with_modes || modal_part);
  }

  void BodyReduction::load_modes()
  {
    modal_part = cache.load_modal(asked.body, modes_key());
    if (modal_part && asked.flows)
    {
      // double modes differ from one computation to the next: a flow of others does not fit
      std::optional<FlowReduction> flow = cache.load_flow(asked.body, modes_key());
      if (flow && flow->omega == modal_part->omega)
        flow_part = std::make_shared<const FlowReduction>(std::move(*flow));
      else
        modal_part.reset();
    }
    if (modal_part && maker.revolve)
    {
      std::optional<RevolvedShapes> section = cache.load_section(asked.body, modes_key());
      if (section && section->omega == modal_part->omega)
        section_part = std::make_shared<const RevolvedShapes>(std::move(*section));
      else
        modal_part.reset();
    }
    if (modal_part)
      run_log().line(asked.body + ": modes found in the cache");
  }

  std::string BodyReduction::modes_file() const
  {
    return asked.cache_directory.empty() ? "" : cache.file_name(asked.body, "modes", modes_key());
  }

  const StaticReduction &BodyReduction::statics()
  {
    const Log::Part part(heading());
    if (!static_part)
    {
      static_part = cache.load_static(asked.body, asked.key);
      if (static_part)
        run_log().line(asked.body + ": contact compliance found in the cache");
    }
    if (!static_part)
    {
      if (maker.revolve)
        revolved();
      else
        flexibility();
      dealii::Timer timer;
      static_part = maker.revolve ? revolved().statics() : reduce_statically(system(), flexibility());
      timings.emplace_back("contact compliance", timer.wall_time());
      cache.save(asked.key, *static_part);
    }
    return *static_part;
  }

  void BodyReduction::compute_modes_now()
  {
    const Log::Part part(heading());
    if (maker.revolve)
    {
      const RevolvedReduction &waves = revolved();
      dealii::Timer timer;
      surface.emplace();
      FlowReduction flow;
      RevolvedShapes section;
      modal_part = waves.modes(asked.modes, *asked.wheel, *surface, section, asked.flows ? &flow : nullptr);
      timings.emplace_back("modes", timer.wall_time());
      cache.save(asked.body, modes_key(), *modal_part);
      cache.save(asked.body, modes_key(), *surface);
      section_part = std::make_shared<const RevolvedShapes>(std::move(section));
      cache.save(asked.body, modes_key(), *section_part);
      if (asked.flows)
      {
        flow_part = std::make_shared<const FlowReduction>(std::move(flow));
        cache.save(asked.body, modes_key(), *flow_part);
      }
      return;
    }
    Flexibility &inverse = flexibility();
    dealii::Timer timer;
    mode_shapes = std::make_unique<Modes>();
    modal_part = reduce_modally(system(), inverse, asked.modes, asked.wheel, mode_shapes.get());
    timings.emplace_back("count of modes", mode_shapes->seconds_count);
    timings.emplace_back("modes", timer.wall_time() - mode_shapes->seconds_count);
    cache.save(asked.body, modes_key(), *modal_part);
    surface = vibrocontact::surface_shapes(system().surface, *mode_shapes);
    cache.save(asked.body, modes_key(), *surface);
    if (asked.flows)
    {
      flow_part = std::make_shared<const FlowReduction>(reduce_flow(system(), inverse, *mode_shapes));
      cache.save(asked.body, modes_key(), *flow_part);
    }
  }

  const ModalReduction &BodyReduction::modal()
  {
    const Log::Part part(heading());
    if (!modal_part)
      load_modes();
    if (!modal_part)
      compute_modes_now();
    return *modal_part;
  }

  const Modes &BodyReduction::shapes()
  {
    if (!mode_shapes)
    {
      system();
      compute_modes_now();
    }
    return *mode_shapes;
  }

  const SurfaceShapes &BodyReduction::surface_shapes()
  {
    const Log::Part part(heading());
    if (!surface)
      surface = cache.load_shapes(asked.body, modes_key());
    if (surface && modal_part && surface->omega != modal_part->omega)
      surface.reset();
    if (!surface)
    {
      if (modal_part)
        run_log().line(asked.body +
                       ": the cache has the modes but not their shapes: the modes are computed again");
      compute_modes_now();
    }
    return *surface;
  }

  bool BodyReduction::has_surface_shapes()
  {
    if (!surface)
      surface = cache.load_shapes(asked.body, modes_key());
    return surface && modal_part && surface->omega == modal_part->omega;
  }

  namespace
  {
    HubInertia hub_inertia(const RevolvedShapes &section)
    {
      const double mass = section.hub[3], moment = section.hub[4];
      HubInertia hub{{{0, section.hub[1], section.hub[2]}}, DenseMatrix(6, 6)};
      for (unsigned int d = 0; d < 3; ++d)
      {
        hub.mass(d, d) = mass;
        hub.mass(3 + d, 3 + d) = section.hub[d == 1 ? 5 : 6];
      }
      hub.mass(0, 5) = hub.mass(5, 0) = -moment;
      hub.mass(2, 3) = hub.mass(3, 2) = moment;
      return hub;
    }
  } // namespace

  ReducedBody BodyReduction::reduced(const bool with_modes)
  {
    const bool moves = with_modes && asked.modes.any();
    ReducedBody body = combine(statics(), moves ? &modal() : nullptr);
    if (moves)
    {
      body.flow = flow_part;
      body.section = section_part;
      if (section_part)
        body.hub = hub_inertia(*section_part);
    }
    return body;
  }

  DenseMatrix BodyReduction::attachment_mass()
  {
    const Log::Part part(heading());
    std::optional<DenseMatrix> mass = cache.load_attachment_mass(asked.body, asked.key);
    if (!mass)
    {
      Flexibility &inverse = flexibility();
      dealii::Timer timer;
      mass = vibrocontact::attachment_mass(system(), inverse);
      timings.emplace_back("inertia of the attachment responses", timer.wall_time());
      cache.save_attachment_mass(asked.body, asked.key, *mass);
    }
    return *mass;
  }
} // namespace vibrocontact
