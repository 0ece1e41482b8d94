#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/reduction_cache.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <filesystem>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    // To be raised when the formulation, not the input, changes what is kept.
    const std::string formulation = "vibrocontact reduction 1\n";

    std::string joined(const std::vector<std::string> &texts)
    {
      std::string result;
      for (const auto &text : texts)
        result += text + '\n';
      return result;
    }

    std::vector<std::string> split(const std::string &text)
    {
      std::vector<std::string> result;
      std::istringstream stream(text);
      for (std::string line; std::getline(stream, line);)
        result.push_back(line);
      return result;
    }

    // The order of write() and read() is the same: the checksum depends on it.
    void write(Hdf5Writer &file, const StaticReduction &part)
    {
      const ContactGrid &g = part.grid;
      file.write("name", part.name);
      file.write("grid", std::vector<double>{double(g.n_x), double(g.n_y), g.spacing_x, g.spacing_y,
                                             g.x_first, g.y_first});
      file.write("n_dofs", std::vector<double>{double(part.n_dofs)});
      file.write("compliance_m_N", part.compliance);
      file.write("load_response_m", part.load_response);
      file.write("lifting", part.lifting);
      file.write("surface_height_m", part.surface_height);
      file.write("rigid_trace", part.rigid_trace);
      file.write("rigid_load", part.rigid_load);
    }

    void read(Hdf5Reader &file, StaticReduction &part)
    {
      ContactGrid &g = part.grid;
      part.name = file.text("name");
      const auto grid = file.vector("grid");
      g.n_x = grid.at(0);
      g.n_y = grid.at(1);
      g.spacing_x = grid.at(2);
      g.spacing_y = grid.at(3);
      g.x_first = grid.at(4);
      g.y_first = grid.at(5);
      part.n_dofs = file.vector("n_dofs").at(0);
      part.compliance = file.matrix("compliance_m_N");
      part.load_response = file.vector("load_response_m");
      part.lifting = file.vector("lifting");
      part.surface_height = file.vector("surface_height_m");
      part.rigid_trace = file.matrix("rigid_trace");
      part.rigid_load = file.vector("rigid_load");
    }

    void write(Hdf5Writer &file, const ModalReduction &part)
    {
      file.write("numbers", std::vector<double>{double(part.n_rigid_modes), double(part.n_dofs),
                                                part.orthonormality_error, part.residual, part.seconds});
      file.write("omega_rad_s", part.omega);
      file.write("damping_ratio", part.damping_ratio);
      file.write("labels", joined(part.labels));
      file.write("trace", part.trace);
      file.write("load", part.load);
    }

    void read(Hdf5Reader &file, ModalReduction &part)
    {
      const auto numbers = file.vector("numbers");
      part.n_rigid_modes = numbers.at(0);
      part.n_dofs = numbers.at(1);
      part.orthonormality_error = numbers.at(2);
      part.residual = numbers.at(3);
      part.seconds = numbers.at(4);
      part.omega = file.vector("omega_rad_s");
      part.damping_ratio = file.vector("damping_ratio");
      part.labels = split(file.text("labels"));
      part.trace = file.matrix("trace");
      part.load = file.vector("load");
    }

    // Replication of the parts: an archive that knows only what they are made of.
    class Broadcast
    {
    public:
      explicit Broadcast(MPI_Comm communicator) : communicator(communicator) {}

      template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
      void operator()(Number &value) const
      {
        MPI_Bcast(&value, sizeof(Number), MPI_BYTE, 0, communicator);
      }
      void operator()(std::string &text) const
      {
        unsigned long long size = text.size();
        (*this)(size);
        text.resize(size);
        MPI_Bcast(text.data(), size, MPI_CHAR, 0, communicator);
      }
      void operator()(std::vector<double> &values) const
      {
        unsigned long long size = values.size();
        (*this)(size);
        values.resize(size);
        MPI_Bcast(values.data(), size, MPI_DOUBLE, 0, communicator);
      }
      void operator()(std::vector<std::string> &texts) const
      {
        std::string text = joined(texts);
        (*this)(text);
        texts = split(text);
      }
      void operator()(DenseMatrix &matrix) const
      {
        unsigned int m = matrix.m(), n = matrix.n();
        (*this)(m);
        (*this)(n);
        if (matrix.m() != m || matrix.n() != n)
          matrix.reinit(m, n);
        for (unsigned int j = 0; j < n && m > 0; ++j)
          MPI_Bcast(&matrix(0, j), m, MPI_DOUBLE, 0, communicator);
      }

    private:
      MPI_Comm communicator;
    };

    void replicate(const Broadcast &all, StaticReduction &part)
    {
      all(part.name);
      all(part.grid.n_x);
      all(part.grid.n_y);
      all(part.grid.spacing_x);
      all(part.grid.spacing_y);
      all(part.grid.x_first);
      all(part.grid.y_first);
      all(part.n_dofs);
      all(part.compliance);
      all(part.load_response);
      all(part.lifting);
      all(part.surface_height);
      all(part.rigid_trace);
      all(part.rigid_load);
    }

    void replicate(const Broadcast &all, ModalReduction &part)
    {
      all(part.n_rigid_modes);
      all(part.n_dofs);
      all(part.omega);
      all(part.damping_ratio);
      all(part.labels);
      all(part.trace);
      all(part.load);
      all(part.orthonormality_error);
      all(part.residual);
      all(part.seconds);
    }

    template <typename Part>
    std::optional<Part> load(const std::string &file_name, const std::string &key, const bool is_host,
                             MPI_Comm communicator)
    {
      Part part;
      unsigned int found = 0;
      if (is_host && std::filesystem::exists(file_name))
        try
        {
          Hdf5Reader file(file_name);
          if (file.text("key") != formulation + key)
            throw std::runtime_error("'" + file_name + "' belongs to another model");
          read(file, part);
          file.verify();
          found = 1;
        }
        catch (const std::exception &error)
        {
          run_log().warning("Cached reduction not used: " + std::string(error.what()) +
                            "; it is computed again.");
        }
      const Broadcast all(communicator);
      all(found);
      if (found == 0)
        return {};
      replicate(all, part);
      return part;
    }

    template <typename Part>
    void save_part(const std::string &file_name, const std::string &key, const Part &part)
    {
      std::filesystem::create_directories(std::filesystem::path(file_name).parent_path());
      Hdf5Writer file(file_name);
      file.write("key", formulation + key);
      write(file, part);
      file.finish();
    }

    // The reduction itself is done: a cache that cannot be written is no reason to stop.
    template <typename Part>
    void try_to_save(const std::string &file_name, const std::string &key, const Part &part)
    {
      try
      {
        save_part(file_name, key, part);
      }
      catch (const std::exception &error)
      {
        run_log().warning("The reduction is not kept: " + std::string(error.what()));
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
    unsigned long long hash = 1469598103934665603ull;
    for (const unsigned char c : formulation + key)
      hash = (hash ^ c) * 1099511628211ull;
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", hash);
    return folder + "/" + body + "-" + kind + "-" + text + ".h5";
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

  void ReductionCache::save(const std::string &key, const StaticReduction &part) const
  {
    if (!folder.empty() && is_host)
      try_to_save(file_name(part.name, "static", key), key, part);
  }

  void ReductionCache::save(const std::string &body, const std::string &key, const ModalReduction &part) const
  {
    if (!folder.empty() && is_host)
      try_to_save(file_name(body, "modes", key), key, part);
  }
} // namespace vibrocontact
