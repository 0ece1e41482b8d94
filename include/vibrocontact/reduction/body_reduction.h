#pragma once

#include <vibrocontact/reduction/reduction_cache.h>
#include <vibrocontact/reduction/revolved_reduction.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// How a meshed body is to be reduced.
  struct ReductionRequest
  {
    /// name of the body, for files and messages
    std::string body;
    /// everything that determines matrices and trace (mesh, material, boundary, grid), as text
    std::string key;
    ModeParameters modes;
    /// of a solid body; the answers are the same to 1e-9, so that it is no part of the key
    StiffnessSolverParameters solver = {};
    /// a wheel's modes are labelled and damped by Eq. 23, any other body's by strain energy
    std::optional<WheelFrame> wheel;
    /// its material turns past its contact points or has Coriolis forces: SecondOrderSystem::flow belongs to its modes
    bool flows = false;
    /// empty: nothing is kept between runs
    std::string cache_directory;
  };

  /// The reductions of one body, each part found in the cache or computed when it is first asked for: a
  /// static analysis computes no modes, a run that finds its parts assembles nothing. All members are
  /// collective.
  class BodyReduction
  {
  public:
    using Assemble = std::function<std::unique_ptr<SecondOrderSystem>()>;
    using Revolve = std::function<std::unique_ptr<RevolvedReduction>()>;
    /// What it is made of: one system, or a problem for each number of waves around an axle.
    struct Maker
    {
      Assemble assemble;
      Revolve revolve = {};
    };

    BodyReduction(const ReductionRequest &request, const Maker &maker, MPI_Comm communicator);

    const StaticReduction &statics();
    const ModalReduction &modal();
    /// The reduced body; without modes W~ is the whole static compliance.
    ReducedBody reduced(bool with_modes);
    /// The modes on the section of a body that is solved by harmonics; null: it is not.
    std::shared_ptr<const RevolvedShapes> revolved_shapes()
    {
      modal();
      return section_part;
    }
    /// What belongs to its modes if it flows or has Coriolis forces; null: neither.
    std::shared_ptr<const FlowReduction> flow()
    {
      modal();
      return flow_part;
    }
    /// Mass of the attachment responses, P_c G M G P_c^T (reduction/attachment_inertia.h).
    DenseMatrix attachment_mass();
    /// The shapes themselves: not kept in the cache, computed if this run has not yet done so.
    const Modes &shapes();
    /// The modes on the body's surface. If the cache has the modes but not these (it was filled by an earlier
    /// version), the modes are computed anew, which is said: ask for them before reduced().
    const SurfaceShapes &surface_shapes();
    /// The points of the surface alone, of a body that is solved by harmonics. Makes its section.
    SurfaceShapes surface_points() { return revolved().surface(); }
    const RevolvedReduction &revolved();
    /// Whether surface_shapes() needs no computation. Collective.
    bool has_surface_shapes();
    bool has_shapes() const { return static_cast<bool>(mode_shapes); }

    /// The assembled system; assembles it. @throws InputError if the body has none, being solved by harmonics
    const SecondOrderSystem &system();
    /// The factorised system; factorises it.
    Flexibility &flexibility();
    bool was_factorised() const { return static_cast<bool>(factorised); }
    /// Before it is factorised: what an automatic choice of the solver has become. Without, it is direct.
    void choose(StiffnessSolver solver) { chosen = solver; }
    StiffnessSolver solver() const { return chosen; }
    /// Whether the parts asked for are in the cache; they are loaded if so. Collective.
    bool is_cached(bool with_statics, bool with_modes);
    /// File that keeps the modes between runs; empty without a cache.
    std::string modes_file() const;
    /// Wall time of each stage that this run did: name and seconds.
    const std::vector<std::pair<std::string, double>> &stages() const { return timings; }
    const ReductionRequest &request() const { return asked; }

  private:
    void compute_modes_now();
    /// Takes the modes from the cache, with all that belongs to them. Collective.
    void load_modes();
    std::string heading() const { return "Reduction of " + asked.body; }
    std::string modes_key() const
    {
      return asked.key + "\nmodes " + asked.modes.key() +
             (maker.revolve ? "\nwith rotations of the hub" : "");
    }

    ReductionRequest asked;
    Maker maker;
    MPI_Comm communicator;
    ReductionCache cache;
    std::unique_ptr<SecondOrderSystem> assembled;
    std::unique_ptr<RevolvedReduction> by_harmonics;
    std::unique_ptr<Flexibility> factorised;
    StiffnessSolver chosen;
    std::optional<StaticReduction> static_part;
    std::optional<ModalReduction> modal_part;
    std::shared_ptr<const FlowReduction> flow_part;
    std::shared_ptr<const RevolvedShapes> section_part;
    std::unique_ptr<Modes> mode_shapes;
    std::optional<SurfaceShapes> surface;
    std::vector<std::pair<std::string, double>> timings;
  };
} // namespace vibrocontact
