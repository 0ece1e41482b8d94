#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/reduction_archive.h>
#include <vibrocontact/reduction/reduction_cache.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

namespace vibrocontact
{
  namespace
  {
    // To be raised when the formulation, not the input, changes what is kept.
    const std::string formulation = "vibrocontact reduction 8\n";

    using namespace reduction_archive;

    template <typename Part>
    std::optional<Part> load(const std::string &file_name, const std::string &key, const bool is_host,
                             MPI_Comm communicator)
    {
      Part part;
      unsigned int found = 0;
      if (is_host)
        try
        {
          if (std::filesystem::exists(file_name))
          {
            Hdf5Reader file(file_name);
            if (file.text("key") != formulation + key)
              throw InputError("The file '" + file_name + "' belongs to another model.");
            const Load archive(file);
            visit(archive, part);
            file.verify();
            found = 1;
          }
        }
        catch (const std::exception &error)
        {
          run_log().warning("A cached reduction is not used but computed again. " +
                            std::string(error.what()));
        }
      const Broadcast all(communicator);
      all("found", found);
      if (found == 0)
        return {};
      visit(all, part);
      return part;
    }

    // The reduction itself is done and results do not depend on the cache: what cannot be kept is reported.
    // Only the host is here, and no exception leaves this function, so no rank waits for another.
    template <typename Part>
    void save_on_host(const std::string &file_name, const std::string &key, const Part &part) noexcept
    {
      try
      {
        std::filesystem::create_directories(std::filesystem::path(file_name).parent_path());
        Hdf5Writer file(file_name);
        file.write("key", formulation + key);
        const Save archive(file);
        visit(archive, part);
        file.finish();
      }
      catch (const std::exception &error)
      {
        run_log().warning("The reduction is not kept in Output/Cache directory: " +
                          std::string(error.what()));
      }
    }
  } // namespace

  ReductionCache::ReductionCache(const std::string &folder, MPI_Comm communicator)
      : folder(folder), communicator(communicator),
        is_host(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }

  std::string ReductionCache::file_name(const std::string &body, const std::string &kind,
                                        const std::string &key) const
  {
    return folder + "/" + body + "-" + kind + "-" + digits_of_key(formulation + key) + ".h5";
  }

  std::optional<StaticReduction> ReductionCache::load_static(const std::string &body,
                                                             const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<StaticReduction>(file_name(body, "static", key), key, is_host, communicator);
  }

  std::optional<ModalReduction> ReductionCache::load_modal(const std::string &body,
                                                           const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<ModalReduction>(file_name(body, "modes", key), key, is_host, communicator);
  }

  std::optional<SurfaceShapes> ReductionCache::load_shapes(const std::string &body,
                                                           const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<SurfaceShapes>(file_name(body, "shapes", key), key, is_host, communicator);
  }

  std::optional<RevolvedShapes> ReductionCache::load_section(const std::string &body,
                                                             const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<RevolvedShapes>(file_name(body, "section", key), key, is_host, communicator);
  }

  std::optional<FlowReduction> ReductionCache::load_flow(const std::string &body,
                                                         const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<FlowReduction>(file_name(body, "flow", key), key, is_host, communicator);
  }

  std::optional<ResponseReduction> ReductionCache::load_response(const std::string &body,
                                                                 const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<ResponseReduction>(file_name(body, "response", key), key, is_host, communicator);
  }

  std::optional<DirectResponse> ReductionCache::load_direct(const std::string &body,
                                                            const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<DirectResponse>(file_name(body, "direct", key), key, is_host, communicator);
  }

  std::optional<TrackReduction> ReductionCache::load_track(const std::string &body,
                                                           const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<TrackReduction>(file_name(body, "track", key), key, is_host, communicator);
  }

  void ReductionCache::save(const std::string &body, const std::string &key,
                            const ResponseReduction &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "response", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const RevolvedShapes &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "section", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const FlowReduction &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "flow", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const DirectResponse &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "direct", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const TrackReduction &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "track", key), key, part);
  }

  void ReductionCache::save(const std::string &key, const StaticReduction &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(part.name, "static", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const ModalReduction &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "modes", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const SurfaceShapes &part) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "shapes", key), key, part);
  }

  std::optional<DenseMatrix> ReductionCache::load_attachment_mass(const std::string &body,
                                                                  const std::string &key) const
  {
    if (folder.empty())
      return {};
    return load<DenseMatrix>(file_name(body, "inertia", key), key, is_host, communicator);
  }

  void ReductionCache::save_attachment_mass(const std::string &body, const std::string &key,
                                            const DenseMatrix &mass) const
  {
    if (!folder.empty() && is_host)
      save_on_host(file_name(body, "inertia", key), key, mass);
  }
} // namespace vibrocontact
