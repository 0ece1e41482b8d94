#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/band_limited.h>
#include <vibrocontact/receptances/pole_file.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  PoleFile sample(const bool direct)
  {
    PoleFile file;
    file.names.labels = {"A_z", "B_z"};
    for (const auto &[response, reference] : {std::pair(0u, 0u), {0u, 1u}, {1u, 0u}, {1u, 1u}})
    {
      FrequencyData::Entry entry;
      entry.response = response;
      entry.reference = reference;
      file.names.entries.push_back(entry);
      const double i = file.names.entries.size();
      file.fit.residues.push_back({{1e-3 / 3 * i, -M_PI / i}, {std::sqrt(i), 0}, {1e-17 / 7, -1e-300 * i}});
      file.fit.direct.push_back(direct ? i / 3e7 : 0.);
    }
    file.fit.poles = {{-100. / 3, 1e3 / 7}, {-1e4 / 9, 0}, {-1e-3 / 11, -5e4 / 13}};
    return file;
  }
} // namespace

TEST(PoleFile, ComesBackBitByBit)
{
  for (const bool direct : {false, true})
  {
    const PoleFile file = sample(direct);
    const std::string text = poles_table(file.fit, file.names, "title").text();
    const PoleFile back = read_poles(read_csv("x.csv", text));
    EXPECT_EQ(back.names.labels, file.names.labels);
    EXPECT_EQ(back.fit.poles, file.fit.poles);
    EXPECT_EQ(back.fit.residues, file.fit.residues);
    EXPECT_EQ(back.fit.direct, file.fit.direct);
    EXPECT_EQ(poles_table(back.fit, back.names, "title").text(), text);
  }
}

TEST(PoleFile, RefusesWhatIsNoTableOfPoles)
{
  const auto refused = [](const std::string &text, const std::string &part)
  {
    try
    {
      read_poles(read_csv("x.csv", text));
      ADD_FAILURE() << "not refused: " << text;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const std::string head = "pole_real_1_s,pole_imag_1_s,A_z_A_z_residue_real_m_Ns,A_z_A_z_residue_imag_m_Ns";
  refused(head + "\n0,3,1,1\n", "unstable pole");
  refused(head + "\n", "no poles");
  refused(head + ",mass\n-1,3,1,1,1\n", "column mass");
  refused(head + ",A_z_A_z_direct_m_N\n-1,3,1,1,1\n-1,4,1,1,2\n", "line 3, has another");
  refused("pole_real_1_s,pole_imag_1_s\n-1,3\n", "no residues");
  refused(head + "\n-1,3,1,1\n-2,3,1,1\n-1,-3,1,-1\n", "line 4, has the pole and the residues of line 2");
  // of a body with a symmetry
  EXPECT_EQ(read_poles(read_csv("x.csv", head + "\n-1,3,1,1\n-1,3,2,1\n")).fit.poles.size(), 2u);
}

TEST(BandLimited, InverseTransformOfAnOscillator)
{
  // 1 kg, 40 Hz, 5 %, 0 to 4000 Hz: what is above the band holds 1e-4 of the static receptance
  const double w = 80 * M_PI, zeta = 0.05, root = w * std::sqrt(1 - zeta * zeta);
  Spectra data;
  data.values.resize(1);
  for (unsigned int l = 0; l <= 8000; ++l)
  {
    data.omega.push_back(M_PI * l);
    data.values[0].push_back(1. /
                             Complex(w * w - data.omega[l] * data.omega[l], 2 * zeta * w * data.omega[l]));
  }
  EntryMap map;
  map.n_rows = 1;
  map.entry = {0};
  const BodyInContact model = band_limited_model(data, map);
  EXPECT_NEAR(band_limited_memory(data), 1, 1e-12);
  for (double t = 0.001; t < 0.5; t += 0.0137)
    EXPECT_NEAR(impulse_response(model, t)(0, 0), std::exp(-zeta * w * t) * std::sin(root * t) / root,
                2e-3 / root);
}
