// Cameras of a scene: chosen by name, by index or for want of others, and what is said when that fails.
#include "engine/scene/camera_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "engine/error.h"

namespace lensgraph {

namespace {

using engine::Camera;
using engine::CameraChoice;
using engine::cameraFromScene;
using engine::CameraType;
using engine::OnlyCamera;
using engine::Scene;
using engine::SceneCamera;
using testing::HasSubstr;

/// Cameras of these names, told apart by their field of view: 0.5 for the first, 0.51 for the next …
Scene sceneWith(const std::vector<std::string>& names) {
  Scene scene;
  for (const auto& name : names) {
    SceneCamera camera;
    camera.name = name;
    camera.fileIndex = static_cast<uint32_t>(scene.cameras.size());
    camera.yfov = 0.5 + 0.01 * static_cast<double>(scene.cameras.size());
    scene.cameras.push_back(camera);
  }
  return scene;
}

/// Which camera of sceneWith() it is.
long chosen(const Scene& scene, const CameraChoice& choice) {
  return std::lround((cameraFromScene(scene, choice).fovy - 0.5) / 0.01);
}

std::string errorOf(const Scene& scene, const CameraChoice& choice) {
  try {
    cameraFromScene(scene, choice);
  } catch (const engine::Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(CameraChoice, ScaleOfTheTransformIsIgnoredAndTheNearPlaneIsTheFiles) {
  glm::dmat4 world = glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3));
  world = glm::rotate(world, 0.5, glm::dvec3(0, 1, 0));
  Scene scene = sceneWith({"main"});
  scene.cameras[0].nodeName = "main node";
  scene.cameras[0].znear = 0.25;
  scene.cameras[0].worldFromCamera = world;
  const Camera plain = cameraFromScene(scene, "main");
  scene.cameras[0].worldFromCamera = glm::scale(world, glm::dvec3(4.0));
  const Camera scaled = cameraFromScene(scene, "main node");
  for (const glm::dvec3 point : {glm::dvec3(0, 0, 0), glm::dvec3(5, -3, 2)}) {
    const glm::dvec4 expected = glm::inverse(world) * glm::dvec4(point, 1.0);
    for (const Camera& camera : {plain, scaled}) {
      const glm::dvec4 actual = camera.viewFromWorld * glm::dvec4(point, 1.0);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-12);
    }
  }
  EXPECT_DOUBLE_EQ(plain.fovy, 0.5);
  EXPECT_DOUBLE_EQ(plain.nearPlane, 0.25);
  EXPECT_DOUBLE_EQ(cameraFromScene(scene, "main", 0.125).nearPlane, 0.125);
}

TEST(CameraChoice, AnIndexChoosesWhetherThereAreNamesOrNot) {
  const Scene scene = sceneWith({"", "A", ""});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(chosen(scene, i), static_cast<long>(i));
    EXPECT_EQ(chosen(scene, std::to_string(i)), static_cast<long>(i));
  }
}

TEST(CameraChoice, ANameOfDigitsGoesBeforeAnIndex) {
  const Scene scene = sceneWith({"1", "B"});
  EXPECT_EQ(chosen(scene, "1"), 0);
  EXPECT_EQ(chosen(scene, std::size_t{1}), 1);
}

TEST(CameraChoice, TheOnlyCameraNeedsNoName) {
  EXPECT_EQ(chosen(sceneWith({""}), OnlyCamera{}), 0);
  EXPECT_EQ(errorOf({}, OnlyCamera{}),
            "camera: the scene has no camera of its own; write \"position\", \"target\" and \"fovyDeg\"");
  EXPECT_EQ(errorOf(sceneWith({"A", ""}), OnlyCamera{}),
            "camera: the scene has 2 cameras; choose one with \"gltfCamera\", its number or name: 0 'A', 1");
}

TEST(CameraChoice, WhatIsNotThereIsAnsweredWithTheCamerasThereAre) {
  const Scene scene = sceneWith({"A", "B"});
  EXPECT_EQ(errorOf(scene, "x"), "camera.gltfCamera: there is no camera 'x' in the scene; it has 0 'A', 1 'B'");
  EXPECT_EQ(errorOf(scene, std::size_t{2}),
            "camera.gltfCamera: there is no camera 2 in the scene; it has 0 'A', 1 'B'");
  for (const char* name : {"2", "-1", "1.0", "0x1", " 0", "99999999999999999999999"}) {
    EXPECT_THAT(errorOf(scene, name), HasSubstr("there is no camera '" + std::string(name) + "'"));
  }
  EXPECT_EQ(errorOf({}, "x"), "camera.gltfCamera: there is no camera 'x' in the scene; the scene has no cameras");
}

TEST(CameraChoice, LongListsAndNamesAreShortened) {
  const Scene many = sceneWith(std::vector<std::string>(1000, "camera with a name"));
  const Scene longNames = sceneWith({std::string(100000, 'n'), std::string(99999, 'n'), "short"});
  for (const auto& error : {errorOf(many, OnlyCamera{}), errorOf(many, std::string(100000, 'x')),
                            errorOf(longNames, OnlyCamera{}), errorOf(longNames, std::size_t{3})}) {
    EXPECT_LT(error.size(), 350u) << error;
    EXPECT_THAT(error, HasSubstr("0 '"));
  }
  EXPECT_THAT(errorOf(many, OnlyCamera{}), HasSubstr(" more"));
}

TEST(CameraChoice, AnOrthographicCameraIsNamedAsSuch) {
  Scene scene = sceneWith({"A", "B", "Ortho"});
  scene.cameras[2].type = CameraType::orthographic;
  const std::string expected =
      "camera.gltfCamera: camera 2 'Ortho' is orthographic: only perspective cameras are rendered";
  EXPECT_EQ(errorOf(scene, "Ortho"), expected);
  EXPECT_EQ(errorOf(scene, std::size_t{2}), expected);
  EXPECT_EQ(chosen(scene, "B"), 1);
  EXPECT_THAT(errorOf(scene, OnlyCamera{}), HasSubstr("2 'Ortho' (orthographic)"));
}

TEST(CameraChoice, NonsenseMattersOnlyInTheCameraThatIsUsed) {
  const double infinity = std::numeric_limits<double>::infinity();
  Scene scene = sceneWith({"good", "wide", "near", "lost", "far"});
  scene.cameras[1].yfov = 0.0;
  scene.cameras[2].znear = 0.0;
  scene.cameras[3].worldFromCamera = glm::dmat4(infinity);
  scene.cameras[4].worldFromCamera[3] = glm::dvec4(0, 1e300, 0, 1);
  EXPECT_EQ(errorOf(scene, "good"), "no error");
  EXPECT_EQ(errorOf(scene, "wide"),
            "camera.gltfCamera: camera 1 'wide' has yfov 0 (cameras[1].perspective of its file), must be above 0 and "
            "below pi");
  EXPECT_EQ(errorOf(scene, "near"),
            "camera.gltfCamera: camera 2 'near' has znear 0 (cameras[2].perspective of its file), must be above 0");
  EXPECT_NO_THROW(cameraFromScene(scene, "near", 0.1));
  EXPECT_THAT(errorOf(scene, "lost"), HasSubstr("camera.gltfCamera: has a transform without a direction"));
  EXPECT_THAT(errorOf(scene, "far"), HasSubstr("camera.gltfCamera: is too far away"));
}

}  // namespace

}  // namespace lensgraph
