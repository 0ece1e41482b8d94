// What a run keeps for another one, a resumed one, or itself is taken only as it was written; one run at a time has a
// folder.
#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/folder_lock.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/reduction/reduction_cache.h>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>

using namespace vibrocontact;

namespace
{
  namespace fs = std::filesystem;

  std::string bytes_of(const std::string &name)
  {
    std::ifstream file(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  void write_bytes(const std::string &name, const std::string &bytes)
  {
    std::ofstream(name, std::ios::binary) << bytes;
  }

  /// Rows of three numbers, `n_blocks` checkpoints of `n` rows each; then rows that no checkpoint counts.
  void write_rows(const std::string &stem, const unsigned int n_blocks, const unsigned int n,
                  const double seed)
  {
    RowFile rows(stem, {"a", "b", "c"});
    for (unsigned int block = 0; block < n_blocks + 1; ++block)
    {
      for (unsigned int i = 0; i < n; ++i)
        rows.add({seed, double(block), double(i)});
      Hdf5Writer writer(stem + (block < n_blocks ? "_checkpoint.h5" : "_later.h5"));
      CheckpointFile file(writer);
      rows.exchange("rows", file);
      writer.finish();
    }
  }

  /// @return rows that the checkpoint counts, taken back; -1 if they are refused
  int resumed_rows(const std::string &stem)
  {
    RowFile rows(stem, {"a", "b", "c"});
    Hdf5Reader reader(stem + "_checkpoint.h5");
    CheckpointFile file(reader);
    try
    {
      rows.exchange("rows", file);
    }
    catch (const RowsLost &)
    {
      return -1;
    }
    return rows.size();
  }
} // namespace

TEST(RowFile, EveryFlippedBitOfACountedRowIsSeen)
{
  const std::string stem = "row_file_test/histories", name = stem + ".rows";
  fs::create_directories("row_file_test");
  write_rows(stem, 3, 4, 0.1);
  EXPECT_EQ(resumed_rows(stem), 12);
  const std::string good = bytes_of(name);
  const std::size_t counted = good.size() * 3 / 4;
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += 1)
  {
    std::string changed = good;
    changed[bit / 8] ^= 1 << bit % 8;
    write_bytes(name, changed);
    EXPECT_EQ(resumed_rows(stem), bit / 8 < counted ? -1 : 12) << "bit " << bit;
  }
  write_bytes(name, good.substr(0, counted - 1));
  EXPECT_EQ(resumed_rows(stem), -1);
  write_bytes(name, good.substr(0, counted));
  EXPECT_EQ(resumed_rows(stem), 12);
  // blocks in another order
  write_bytes(name, good.substr(counted / 3, counted / 3) + good.substr(0, counted / 3) +
                        good.substr(2 * counted / 3));
  EXPECT_EQ(resumed_rows(stem), -1);
  // rows of another run, as many
  write_rows("row_file_test/other", 3, 4, 0.2);
  fs::copy_file("row_file_test/other.rows", name, fs::copy_options::overwrite_existing);
  EXPECT_EQ(resumed_rows(stem), -1);
  fs::remove_all("row_file_test");
}

TEST(RowFile, AFinishedFileGoesOnFromItsColumnsUnlessTheyAreDamaged)
{
  const std::string stem = "row_columns_test/histories";
  fs::create_directories("row_columns_test");
  {
    RowFile rows(stem, {"a", "b", "c"});
    for (unsigned int i = 0; i < 5; ++i)
      rows.add({1., double(i), 3.});
    Hdf5Writer writer(stem + "_checkpoint.h5");
    CheckpointFile file(writer);
    rows.exchange("rows", file);
    writer.finish();
    rows.finish(true);
  }
  EXPECT_FALSE(fs::exists(stem + ".rows"));
  EXPECT_EQ(resumed_rows(stem), 5);
  std::string bytes = bytes_of(stem + ".h5");
  const double three[] = {3., 3., 3., 3., 3.};
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char *>(three), sizeof three));
  ASSERT_NE(place, std::string::npos);
  bytes[place + 3] ^= 4;
  write_bytes(stem + ".h5", bytes);
  EXPECT_EQ(resumed_rows(stem), -1);
  fs::remove_all("row_columns_test");
}

TEST(Hdf5File, EveryDamagedByteIsSeenBeforeTheFileIsOpened)
{
  const std::string name = "seal_test.h5";
  Hdf5Writer writer(name);
  writer.write("state", std::vector<double>{0.1, 0.2, 0.3});
  writer.finish(true);
  EXPECT_NO_THROW(Hdf5Reader::check_seal(name));
  EXPECT_EQ(Hdf5Reader(name).numbers("state").at(2), 0.3);
  const std::string good = bytes_of(name);
  for (std::size_t i = 0; i < good.size(); ++i)
  {
    std::string changed = good;
    changed[i] ^= 1 << i % 8;
    write_bytes(name, changed);
    EXPECT_THROW(Hdf5Reader::check_seal(name), InputError) << "byte " << i;
  }
  for (const std::size_t size : {good.size() - 1, good.size() / 2, std::size_t(7), std::size_t(0)})
  {
    write_bytes(name, good.substr(0, size));
    EXPECT_THROW(Hdf5Reader::check_seal(name), InputError) << size << " bytes";
  }
  fs::remove(name);
}

TEST(Utf8, LabelsOfDataFilesThatAreLatin1AreTakenOver)
{
  EXPECT_EQ(as_utf8("B\xfcro"), "B\xc3\xbcro");
  EXPECT_EQ(as_utf8("B\xc3\xbcro"), "B\xc3\xbcro");
  EXPECT_EQ(first_byte_outside_utf8(as_utf8("\xff\x80\xe4z")), as_utf8("\xff\x80\xe4z").size());
  EXPECT_EQ(read_csv("table", "frequency_Hz,B\xfcro_z_m\n1,2\n").names[1], "B\xc3\xbcro_z_m");
  // whatever else comes along ends in a file that can be read
  Results results;
  results.analyses["modes"] = {{"folder", "Stra\xdf"
                                          "e"}};
  const std::string text = results_text(results, 0);
  EXPECT_EQ(first_byte_outside_utf8(text), text.size());
  EXPECT_NO_THROW(results_of_text(text));
}

namespace
{
  /// Replaces a set of an HDF5 file. @param fill writes it, or leaves it as announced
  void replace_set(const std::string &file_name, const std::string &name, const hid_t type, const hid_t space,
                   const bool chunked, const std::function<void(hid_t)> &fill)
  {
    const hid_t file = H5Fopen(file_name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                kept = H5Pcreate(H5P_DATASET_CREATE);
    ASSERT_GE(file, 0);
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    const hsize_t chunk = 1024;
    if (chunked)
      H5Pset_chunk(kept, 1, &chunk);
    const hid_t set = H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, kept, H5P_DEFAULT);
    ASSERT_GE(set, 0);
    fill(set);
    H5Dclose(set);
    H5Pclose(kept);
    H5Fclose(file);
  }

  hid_t list_of(const hsize_t n)
  {
    return H5Screate_simple(1, &n, nullptr);
  }

  hid_t text_of(const std::size_t size)
  {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    return type;
  }
} // namespace

TEST(ReductionCache, DamagedFilesAreComputedAgain)
{
  const std::string folder = "damaged_cache_test";
  const ReductionCache cache(folder, MPI_COMM_SELF);
  ModalReduction part;
  part.omega = {1., 2., 3.};
  part.damping_ratio = {0.1, 0.1, 0.1};
  part.labels = {"one", "two", "three"};
  part.load = {0., 0., 0.};
  part.trace.reinit(2, 3);
  part.participation.reinit(3, 3);
  cache.save("bar", "key", part);
  const std::string name = cache.file_name("bar", "modes", "key"), good = bytes_of(name);
  ASSERT_TRUE(cache.load_modal("bar", "key"));

  const auto is_refused = [&](const std::function<void()> &damage)
  {
    write_bytes(name, good);
    damage();
    return !cache.load_modal("bar", "key").has_value();
  };
  for (const char *set : {"key", "labels"})
  {
    // as many texts as there is room for in a thousand buffers of one
    EXPECT_TRUE(is_refused(
        [&]
        {
          const std::vector<char> texts(1000 * 40, 'x');
          const hid_t type = text_of(40);
          replace_set(name, set, type, list_of(1000), false,
                      [&](const hid_t id)
                      { H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()); });
        }))
        << set;
    EXPECT_TRUE(is_refused(
        [&]
        {
          const std::vector<const char *> texts(1000, "x");
          const hid_t type = text_of(H5T_VARIABLE);
          replace_set(name, set, type, list_of(1000), false,
                      [&](const hid_t id)
                      { H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()); });
        }))
        << set;
    EXPECT_TRUE(is_refused(
        [&]
        { replace_set(name, set, text_of((1ul << 31) - 10), H5Screate(H5S_SCALAR), false, [](hid_t) {}); }))
        << set;
    EXPECT_TRUE(
        is_refused([&] { replace_set(name, set, text_of(8), H5Screate(H5S_NULL), false, [](hid_t) {}); }))
        << set;
  }
  for (const hsize_t size : {hsize_t(1) << 34, hsize_t(1) << 45, hsize_t(1) << 62})
    EXPECT_TRUE(is_refused(
        [&] { replace_set(name, "omega_rad_s", H5T_IEEE_F64LE, list_of(size), true, [](hid_t) {}); }))
        << size;
  for (std::size_t place = 0; place < good.size(); place += 97)
    is_refused(
        [&]
        {
          std::string changed = good;
          changed[place] ^= 0x10;
          write_bytes(name, changed);
        });
  write_bytes(name, good);
  EXPECT_TRUE(cache.load_modal("bar", "key"));
  fs::remove_all(folder);
}

TEST(FolderLock, OneRunAtATime)
{
  const std::string folder = "folder_lock_test/deep/er";
  const auto refusal = [&]
  {
    try
    {
      const FolderLock second(folder, "second.prm", true);
    }
    catch (const InputError &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  auto first = std::make_unique<FolderLock>(folder, "first.prm", true);
  const std::string text = refusal();
  for (const char *part :
       {"another run writes to the folder", "process ", " since 20", "first.prm", "--output"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_TRUE(fs::exists(folder));
  first.reset();
  // nothing was put there: nothing is left
  EXPECT_FALSE(fs::exists("folder_lock_test"));
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(fs::exists("folder_lock_test"));

  // a lock that a killed run left says nothing, what stands there stays
  fs::create_directories(folder);
  write_bytes(folder + "/.vibrocontact_lock", "process 1 on host since ever\n");
  write_bytes(folder + "/table.csv", "x\n");
  EXPECT_EQ(refusal(), "");
  EXPECT_TRUE(fs::exists(folder + "/table.csv"));
  EXPECT_FALSE(fs::exists(folder + "/.vibrocontact_lock"));
  // a run that resumes makes no folder
  const FolderLock resumed("folder_lock_test/none", "first.prm", false);
  EXPECT_FALSE(fs::exists("folder_lock_test/none"));
  fs::remove_all("folder_lock_test");
  EXPECT_THROW(FolderLock("/proc/nowhere", "first.prm", true), InputError);
}
