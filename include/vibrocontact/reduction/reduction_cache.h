#pragma once

#include <vibrocontact/reduction/flow_reduction.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/reduction/response_reduction.h>
#include <vibrocontact/reduction/revolved_shapes.h>
#include <vibrocontact/reduction/surface_shapes.h>
#include <vibrocontact/waveguide/track_reduction.h>

#include <optional>
#include <string>

namespace vibrocontact
{
  /// Reductions kept between runs, one HDF5 file each: `<folder>/<body>-static-<hash>.h5`,
  /// `...-modes-<hash>.h5` and, with the key of the modes, `...-shapes-<hash>.h5`, `...-section-<hash>.h5` and `...-flow-<hash>.h5`; for the
  /// frequency response `...-response-<hash>.h5` and `...-direct-<hash>.h5`; for periodic rails `...-track-<hash>.h5` and
  /// `...-direct-<hash>.h5` of the bands that poles in time follow.
  ///
  /// The key is everything that determines the contents, as text; the hash is of key and formulation version
  /// and names the file, the whole key stands in it and is compared. A file that is damaged or belongs to
  /// something else is reported, not used, and written anew. Rank 0 reads and writes, all ranks get the
  /// result; all members are collective.
  class ReductionCache
  {
  public:
    /// An empty folder name: nothing is kept. The folder is made when something is saved.
    ReductionCache(const std::string &folder, MPI_Comm communicator);

    std::optional<StaticReduction> load_static(const std::string &body, const std::string &key) const;
    std::optional<ModalReduction> load_modal(const std::string &body, const std::string &key) const;
    std::optional<SurfaceShapes> load_shapes(const std::string &body, const std::string &key) const;
    std::optional<RevolvedShapes> load_section(const std::string &body, const std::string &key) const;
    std::optional<FlowReduction> load_flow(const std::string &body, const std::string &key) const;
    std::optional<ResponseReduction> load_response(const std::string &body, const std::string &key) const;
    std::optional<TrackReduction> load_track(const std::string &body, const std::string &key) const;
    std::optional<DirectResponse> load_direct(const std::string &body, const std::string &key) const;
    void save(const std::string &key, const StaticReduction &part) const;
    void save(const std::string &body, const std::string &key, const ModalReduction &part) const;
    void save(const std::string &body, const std::string &key, const SurfaceShapes &part) const;
    void save(const std::string &body, const std::string &key, const RevolvedShapes &part) const;
    void save(const std::string &body, const std::string &key, const FlowReduction &part) const;
    void save(const std::string &body, const std::string &key, const ResponseReduction &part) const;
    void save(const std::string &body, const std::string &key, const DirectResponse &part) const;
    void save(const std::string &body, const std::string &key, const TrackReduction &part) const;

    /// attachment_mass() of a body, in a file of its own: only stability asks for it
    std::optional<DenseMatrix> load_attachment_mass(const std::string &body, const std::string &key) const;
    void save_attachment_mass(const std::string &body, const std::string &key, const DenseMatrix &mass) const;

    /// File of a part: `kind` is "static", "modes", "shapes", "section", "flow", "response", "direct", "track" or "inertia".
    std::string file_name(const std::string &body, const std::string &kind, const std::string &key) const;

  private:
    std::string folder;
    MPI_Comm communicator;
    bool is_host;
  };
} // namespace vibrocontact
