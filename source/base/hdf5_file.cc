#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/hdf5_file.h>

#include <deal.II/base/exceptions.h>

#include <hdf5.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

namespace vibrocontact
{
  namespace
  {
    /// An identifier of HDF5 that is given back at the end of the scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*const close)(hid_t)) : id(id), close(close) {}
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      Handle(const Handle &) = delete;
      Handle &operator=(const Handle &) = delete;
      operator hid_t() const { return id; }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    // HDF5 prints its own stack of errors otherwise.
    void silence()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    void write_set(const hid_t file, const std::string &file_name, const std::string &name,
                   const hid_t memory_type, const hid_t file_type, const void *data,
                   const std::vector<hsize_t> &sizes, const bool compressed)
    {
      const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), kept(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_create_intermediate_group(links, 1);
      if (compressed && sizes.size() == 1 && sizes[0] > 1000)
      {
        const hsize_t chunk = std::min<hsize_t>(sizes[0], 1u << 16);
        H5Pset_chunk(kept, 1, &chunk);
        H5Pset_shuffle(kept);
        H5Pset_deflate(kept, 6);
      }
      const Handle space(sizes.empty() ? H5Screate(H5S_SCALAR)
                                       : H5Screate_simple(sizes.size(), sizes.data(), nullptr),
                         H5Sclose);
      const Handle set(H5Dcreate2(file, name.c_str(), file_type, space, links, kept, H5P_DEFAULT), H5Dclose);
      if (set < 0 || H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
        throw OutputError("Cannot write '" + name + "' to the file '" + file_name +
                          "': there is no memory for it.");
    }

    hid_t open_set(const hid_t file, const std::string &file_name, const std::string &name, const bool there)
    {
      const hid_t set = there ? H5Dopen2(file, name.c_str(), H5P_DEFAULT) : -1;
      if (set < 0)
        throw InputError("The file '" + file_name + "' has no '" + name +
                         "': it is damaged or was written for something else; write it anew.");
      return set;
    }

    /// What a file announces has to be in it before room is made for it: deflate packs 1,032 bytes into one at the
    /// most.
    void check_announced(const hid_t set, const std::string &file_name, const std::string &name,
                         const double n_bytes)
    {
      const double most_packed = 1032, head = 64;
      if (n_bytes > 0 && n_bytes > most_packed * H5Dget_storage_size(set) + head)
        throw InputError("'" + name + "' in the file '" + file_name +
                         "' announces more than the file holds: it is damaged; write it anew.");
    }

    /// What follows the bytes of a sealed file.
    std::string seal_of(const std::string_view bytes)
    {
      Checksum sum;
      sum.add(bytes.data(), bytes.size());
      const unsigned long long value = sum.value();
      return std::string(reinterpret_cast<const char *>(&value), sizeof value);
    }

    // Sizes of a set, then its data.
    template <typename T>
    std::vector<T> read_set(const hid_t set_id, const std::string &file_name, const std::string &name,
                            const hid_t type, const std::size_t size, std::vector<hsize_t> &sizes)
    {
      const Handle set(set_id, H5Dclose), space(H5Dget_space(set), H5Sclose);
      sizes.resize(std::max(0, H5Sget_simple_extent_ndims(space)));
      H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
      const hssize_t n_points = H5Sget_simple_extent_npoints(space);
      if (n_points < 0)
        throw InputError("'" + name + "' in the file '" + file_name + "' has no size; write the file anew.");
      if (size > 0 && static_cast<std::size_t>(n_points) != size)
        throw InputError("'" + name + "' in the file '" + file_name + "' has " + std::to_string(n_points) +
                         " values where " + std::to_string(size) + " are due; write the file anew.");
      check_announced(set, file_name, name, sizeof(T) * static_cast<double>(n_points));
      std::vector<T> data(n_points);
      if (!data.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
        throw InputError("'" + name + "' in the file '" + file_name +
                         "' cannot be read as numbers; write the file anew.");
      return data;
    }
  } // namespace

  Hdf5Writer::Hdf5Writer(const std::string &file_name) : file_name(file_name)
  {
    silence();
    const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(in_memory, 1u << 20, false);
    file = H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory);
    if (file < 0)
      throw OutputError("Cannot write the file '" + file_name + "': there is no memory for it.");
  }

  Hdf5Writer::~Hdf5Writer()
  {
    if (file >= 0)
      H5Fclose(file);
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<double> &values,
                         const Hdf5Storage &storage)
  {
    // the checksum is of what a reader gets back
    std::vector<double> kept = values;
    if (storage.single_precision)
      for (double &value : kept)
        value = static_cast<float>(value);
    write_set(file, file_name, name, H5T_NATIVE_DOUBLE,
              storage.single_precision ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, kept.data(), {kept.size()},
              storage.compressed);
    checksum.add(kept);
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<int> &values, const Hdf5Storage &storage)
  {
    write_set(file, file_name, name, H5T_NATIVE_INT, H5T_STD_I32LE, values.data(), {values.size()},
              storage.compressed);
    checksum.add(values);
  }

  void Hdf5Writer::write(const std::string &name, const double value)
  {
    write(name, std::vector<double>{value});
  }

  void Hdf5Writer::write(const std::string &name, const int value)
  {
    write(name, std::vector<int>{value});
  }

  void Hdf5Writer::write(const std::string &name, const DenseMatrix &matrix)
  {
    // HDF5 counts rows first: the file holds the transposed, column by column, so that columns are
    // contiguous.
    const std::vector<hsize_t> sizes = {matrix.n(), matrix.m()};
    const double *const data = matrix.m() * matrix.n() > 0 ? &matrix(0, 0) : nullptr;
    write_set(file, file_name, name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, data, sizes, false);
    checksum.add(data, sizes[0] * sizes[1] * sizeof(double));
  }

  void Hdf5Writer::write(const std::string &name, const std::string &text)
  {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, text.size() + 1);
    write_set(file, file_name, name, type, type, text.c_str(), {}, false);
    checksum.add(text.data(), text.size());
  }

  void Hdf5Writer::finish(const bool sealed)
  {
    {
      const Handle space(H5Screate(H5S_SCALAR), H5Sclose),
          attribute(H5Acreate2(file, "checksum", H5T_NATIVE_ULLONG, space, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
      const unsigned long long written = checksum.value();
      AssertThrow(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_ULLONG, &written) >= 0,
                  dealii::ExcInternalError());
    }
    // the memory of the file itself, which is longer: no copy of it is made
    void **image = nullptr;
    AssertThrow(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0 &&
                    H5Fget_vfd_handle(file, H5P_DEFAULT, reinterpret_cast<void **>(&image)) >= 0,
                dealii::ExcInternalError());
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    AssertThrow(size > 0, dealii::ExcInternalError());
    const std::string_view bytes(static_cast<const char *>(*image), size);
    write_file(file_name, sealed ? std::string(bytes) + seal_of(bytes) : bytes);
    H5Fclose(file);
    file = -1;
  }

  Hdf5Reader::Hdf5Reader(const std::string &file_name) : file_name(file_name)
  {
    silence();
    file = H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
      throw InputError("The file '" + file_name +
                       "' is missing or no HDF5 file; give the path of an existing one.");
  }

  Hdf5Reader::~Hdf5Reader()
  {
    H5Fclose(file);
  }

  void Hdf5Reader::check_seal(const std::string &file_name)
  {
    std::ifstream file(file_name, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const std::size_t size = std::max(bytes.size(), sizeof(unsigned long long)) - sizeof(unsigned long long);
    if (bytes.substr(size) != seal_of(std::string_view(bytes).substr(0, size)))
      throw InputError("The file '" + file_name + "' is damaged or incomplete; write it anew.");
  }

  bool Hdf5Reader::has(const std::string &name) const
  {
    for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1))
      if (H5Lexists(file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
        return false;
    return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<double> Hdf5Reader::numbers(const std::string &name, const std::size_t size)
  {
    std::vector<hsize_t> sizes;
    const auto values = read_set<double>(open_set(file, file_name, name, has(name)), file_name, name,
                                         H5T_NATIVE_DOUBLE, size, sizes);
    checksum.add(values);
    return values;
  }

  std::vector<int> Hdf5Reader::integers(const std::string &name, const std::size_t size)
  {
    std::vector<hsize_t> sizes;
    const auto values = read_set<int>(open_set(file, file_name, name, has(name)), file_name, name,
                                      H5T_NATIVE_INT, size, sizes);
    checksum.add(values);
    return values;
  }

  DenseMatrix Hdf5Reader::matrix(const std::string &name)
  {
    std::vector<hsize_t> sizes;
    const auto values = read_set<double>(open_set(file, file_name, name, has(name)), file_name, name,
                                         H5T_NATIVE_DOUBLE, 0, sizes);
    if (sizes.size() != 2)
      throw InputError("'" + name + "' in the file '" + file_name + "' is no matrix; write the file anew.");
    checksum.add(values);
    DenseMatrix result(sizes[1], sizes[0]);
    if (!values.empty())
      std::copy(values.begin(), values.end(), &result(0, 0));
    return result;
  }

  std::string Hdf5Reader::text(const std::string &name)
  {
    const Handle set(open_set(file, file_name, name, has(name)), H5Dclose), type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    // one text: an array of them would be read into the room for one
    const bool one = H5Tget_class(type) == H5T_STRING && H5Sget_simple_extent_npoints(space) == 1,
               variable = one && H5Tis_variable_str(type) > 0;
    if (one && !variable)
      check_announced(set, file_name, name, H5Tget_size(type));
    char *there = nullptr;
    std::string text(one && !variable ? H5Tget_size(type) : 0, '\0');
    void *const place = variable ? static_cast<void *>(&there) : text.data();
    if (!one || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, place) < 0)
      throw InputError("'" + name + "' in the file '" + file_name + "' is no text; write the file anew.");
    if (there)
    {
      text = there;
      H5free_memory(there);
    }
    text.resize(std::min(text.find('\0'), text.size()));
    checksum.add(text.data(), text.size());
    return text;
  }

  void Hdf5Reader::verify() const
  {
    unsigned long long written = 0;
    const Handle attribute(H5Aopen(file, "checksum", H5P_DEFAULT), H5Aclose),
        space(attribute < 0 ? -1 : H5Aget_space(attribute), H5Sclose);
    if (space < 0 || H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(attribute, H5T_NATIVE_ULLONG, &written) < 0 || written != checksum.value())
      throw InputError("The contents of the file '" + file_name + "' are damaged; write it anew.");
  }
} // namespace vibrocontact
