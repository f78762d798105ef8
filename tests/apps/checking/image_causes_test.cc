#include "apps/checking/image_causes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// Two shots of 400 rows under one LED each; the columns are smooth functions of the row.
class ImageCausesTest : public ::testing::Test {
 protected:
  static constexpr Eigen::Index kRows = 400;
  ImageCausesTest() {
    for (const char* name : {"led1", "led2"}) {
      SceneLight led;
      led.name = name;
      led.led()->position_std_mm = 0.2;
      scene_.lights.push_back(led);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      SceneShot shot;
      shot.file = i == 0 ? "a.dng" : "b.dng";
      shot.lights = {i == 0 ? "led1" : "led2"};
      scene_.shots.push_back(shot);
    }
    system_.shot_rows = {kRows, kRows};
    model_.predicted.resize(2 * kRows);
    model_.jacobian.resize(2 * kRows, 2);
    system_.std_l = Eigen::VectorXd::Constant(2 * kRows, 1e-3);
    for (Eigen::Index j = 0; j < 2 * kRows; ++j) {
      const double x = static_cast<double>(j % kRows) / kRows;
      model_.predicted[j] = 1.0 + 0.5 * std::sin(3.0 * x + (j < kRows ? 0.0 : 1.0));
      model_.jacobian(j, 0) = std::exp(-2.0 * x);
      model_.jacobian(j, 1) = std::exp(-5.0 * x);
    }
    model_.scale_relative_std = 0.02;
    for (int led = 0; led < 2; ++led) {
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::VectorXd column = Eigen::VectorXd::Zero(2 * kRows);
        for (Eigen::Index j = 0; j < kRows; ++j) {
          column[led * kRows + j] =
              0.01 * std::cos((4.0 + axis) * static_cast<double>(j) / kRows + axis + 1.0);
        }
        add_nuisance("led" + std::to_string(led + 1) + ".position" + std::to_string(axis),
                     "LED position", 2.0, column);
      }
    }
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    noise_ = Eigen::VectorXd::NullaryExpr(2 * kRows, [&] { return 1e-3 * normal(random); });
  }
  void add_nuisance(const std::string& name, const std::string& group, double std,
                    const Eigen::VectorXd& column) {
    system_.nuisances.push_back({group, std, true, name});
    system_.nuisance_columns.conservativeResize(2 * kRows, system_.nuisance_columns.cols() + 1);
    system_.nuisance_columns.rightCols<1>() = column;
  }
  std::vector<ImageCause> causes(const Eigen::VectorXd& change) {
    system_.l = model_.predicted + noise_ + change;
    return image_causes(scene_, {&scene_.shots[0], &scene_.shots[1]}, system_, model_);
  }

  Scene scene_;
  DenseSystem system_;
  LinearModel model_;
  Eigen::VectorXd noise_;
};

TEST_F(ImageCausesTest, NothingIsWrong) {
  for (const ImageCause& c : causes(Eigen::VectorXd::Zero(2 * kRows))) {
    EXPECT_LT(c.chi2_drop, 25.0 + 2.0 * c.parameters) << c.text;
  }
}

TEST_F(ImageCausesTest, AnLedDisplaced) {
  const Eigen::VectorXd change = 8.0 * system_.nuisance_columns.col(4);
  const auto found = causes(change);
  EXPECT_EQ(found.front().text, "led2 displaced");
  EXPECT_EQ(found.front().parameters, 3);
  EXPECT_GT(found.front().share, 0.9);
}

TEST_F(ImageCausesTest, LightFromElsewhere) {
  const auto found = causes(Eigen::VectorXd::Constant(2 * kRows, 0.05));
  EXPECT_EQ(found.front().text, "light from elsewhere");
  EXPECT_FALSE(found.front().advice.empty());
}

TEST_F(ImageCausesTest, OneShotBrighter) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(2 * kRows);
  change.head(kRows) = 0.2 * model_.predicted.head(kRows);
  const auto found = causes(change);
  EXPECT_TRUE(found.front().text.starts_with("light of ")) << found.front().text;
  EXPECT_GT(found.front().share, 0.5);
}

}  // namespace
}  // namespace scattermeter::apps
