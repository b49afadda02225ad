#include "src/scene/scene.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene with this text whose table has these rows.
class Tabled {
public:
  Tabled(const std::string& scene, const std::string& table) {
    dir_.write("t.csv", table);
    file_ = dir_.write("s.toml", scene);
  }
  [[nodiscard]] Scene load() const { return loadScene(file_); }
  /// The messages, without the folder.
  [[nodiscard]] std::string errors() const {
    std::string text = errorOf([this] { static_cast<void>(load()); });
    const std::string folder = dir_.path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    return text;
  }

private:
  TempDir dir_;
  std::filesystem::path file_;
};

TEST(BodyTable, RowsAreTheBodiesThatTablesOfTheSceneWouldBe) {
  const Scene tabled =
      Tabled("[[bodies]]\ntable = 't.csv'\ngroup = 'balls'\nfill = 'red'\nmass = 2\nradius = 7\n",
             "name,x,y,radius,vx,vy,fill,gravity,mass\n"
             "a,10,20,5,1,-2,blue,,\n"
             "\"b\",1.5e2,+20,,0,0,\"{ image = \"\"" OFFSTAGE_SOURCE_DIR
             "/scenes/images/ball.png\"\" }\",false,3\n"
             "# a comment\n"
             ",0,0,,,,,true,\n")
          .load();
  const Scene written =
      Tabled("[[body]]\nname='a'\ngroup='balls'\ncenter=[10,20]\nradius=5\nvelocity=[1,-2]\nfill='blue'"
             "\nmass=2\n"
             "[[body]]\nname='b'\ngroup='balls'\ncenter=[150,20]\nradius=7\ngravity=false\nmass=3\n"
             "fill={ image='" OFFSTAGE_SOURCE_DIR "/scenes/images/ball.png' }\n"
             "[[body]]\ngroup='balls'\ncenter=[0,0]\nradius=7\nfill='red'\nmass=2\n",
             "")
          .load();
  ASSERT_EQ(tabled.world.bodies.size(), 3U);
  EXPECT_EQ(tabled.bodyNames, written.bodyNames);
  EXPECT_EQ(tabled.world.groups, written.world.groups);
  for (std::size_t i = 0; i < 3; ++i) {
    const Body& found = tabled.world.bodies[i];
    const Body& wanted = written.world.bodies[i];
    EXPECT_EQ(found.id, wanted.id);
    EXPECT_EQ(found.position, wanted.position) << i;
    EXPECT_EQ(found.velocity, wanted.velocity) << i;
    EXPECT_EQ(found.radius, wanted.radius) << i;
    EXPECT_EQ(found.mass, wanted.mass) << i;
    EXPECT_EQ(found.feelsGravity, wanted.feelsGravity) << i;
    EXPECT_EQ(tabled.looks[found.look].fill.has_value(), written.looks[wanted.look].fill.has_value()) << i;
    EXPECT_EQ(tabled.looks[found.look].fill->index(), written.looks[wanted.look].fill->index()) << i;
  }
}

TEST(BodyTable, ShapesMayDifferFromRowToRow) {
  const Scene scene = Tabled("[[bodies]]\ntable = 't.csv'\nradius = 4\n",
                             "shape,x,y,width,height\n,1,2,,\nrectangle,3,4,50,60\n")
                          .load();
  EXPECT_EQ(scene.world.bodies[0].shape, Shape::Circle);
  EXPECT_EQ(scene.world.bodies[0].radius, 4.0);
  EXPECT_EQ(scene.world.bodies[1].shape, Shape::Rectangle);
  EXPECT_EQ(scene.world.bodies[1].position, Vec2(3, 4));
  EXPECT_EQ(scene.world.bodies[1].size, Vec2(50, 60));
  EXPECT_EQ(scene.world.bodies[1].radius, 0.0);
}

TEST(BodyTable, PairsMayStandInOneCellAndInMetres) {
  const Scene scene = Tabled("[view]\npixels_per_metre = 10\norigin = [0, 480]\ny_up = true\n"
                             "[[bodies]]\ntable = 't.csv'\n",
                             "center,radius,velocity\n\"[1, 2]\",0.5,3 4\n")
                          .load();
  EXPECT_EQ(scene.world.bodies[0].position, Vec2(10, 460));
  EXPECT_EQ(scene.world.bodies[0].radius, 5.0);
  EXPECT_EQ(scene.world.bodies[0].velocity, Vec2(30, -40));
}

TEST(BodyTable, WhatIsWrongIsNamedWithItsPlace) {
  const std::string scene = "[[bodies]]\ntable = 't.csv'\n";
  const auto errors = [&](const std::string& table) { return Tabled(scene, table).errors(); };
  EXPECT_THAT(errors("x,y,radius\n1,2,-3\n"),
              HasSubstr("t.csv:2:5: error: 'radius' of a body must be at least 0, but it is \"-3\""));
  EXPECT_THAT(errors("x,y,radius\n1,,3\n"),
              HasSubstr("t.csv:2:1: error: a circle needs 'y', and the cell is empty"));
  EXPECT_THAT(errors("x,radius\n1,3\n2,3\n"),
              HasSubstr("t.csv:2:1: error: a circle needs 'y', and the table has no such column"));
  EXPECT_THAT(errors("x,y,radius\n1,2,3\n1;5,2,3\n"),
              HasSubstr("t.csv:3:1: error: 'x' of a body must be a finite number, but it is \"1;5\""));
  EXPECT_THAT(errors("center,radius\n12-3,3\n"),
              HasSubstr("t.csv:2:1: error: 'center' of a body must be two finite numbers"));
  EXPECT_THAT(errors("center,radius\n\"[1,,2]\",3\n"), HasSubstr("must be two finite numbers"));
  EXPECT_THAT(errors("x,y,radius\n1,nan,3\n"),
              HasSubstr("t.csv:2:3: error: 'y' of a body must be a finite number"));
  EXPECT_THAT(
      errors("x,y,raduis\n"),
      HasSubstr("t.csv:1:5: error: the column \"raduis\" is no key of [[body]]; did you mean 'radius'?"));
  EXPECT_THAT(errors("x,y,center,radius\n"),
              HasSubstr("t.csv:1:5: error: the column 'center' says again what another says"));
  EXPECT_THAT(errors("x,y,radius\n1,2,3,4\n"),
              HasSubstr("t.csv:2:1: error: this line has 4 cells, but the first line names 3 columns; "
                        "numbers need a decimal point"));
  EXPECT_THAT(errors("x,y,radius,fill\n1,2,3,purpel\n"),
              HasSubstr("t.csv:2:7: error: 'fill' in [[bodies]] must be a colour"));
  EXPECT_THAT(errors("x,y,radius,name\n1,2,3,a\n4,5,6,a\n"),
              HasSubstr("t.csv:3:7: error: the name \"a\" is another body's"));
  EXPECT_THAT(
      errors("x,y,radius,shape,width,height\n1,2,3,rectangle,4,5\n"),
      HasSubstr("t.csv:2:5: error: 'radius' of a body belongs to a circle, but this shape is a rectangle"));
  const auto unclosed = [](const std::string& place) { // and nothing about what the quote has swallowed
    return AllOf(HasSubstr(place + ": error: this quote is never closed"), Not(HasSubstr("cell")),
                 Not(HasSubstr("number")));
  };
  EXPECT_THAT(errors("x,y,radius\n\"1,2,3\n"), unclosed("t.csv:2:1"));
  EXPECT_THAT(errors("x,y,radius\n1,2,\"3\n"), unclosed("t.csv:2:5"));
  EXPECT_THAT(errors("x,\"y,radius\n1,2,3\n"), unclosed("t.csv:1:3"));
  EXPECT_THAT(errors("x;y;radius\n1;2;3\n"),
              HasSubstr("t.csv:1:1: error: the column \"x;y;radius\" is no key of [[body]]; between the "
                        "cells of a table stand commas"));
  EXPECT_THAT(errors("x,y,radius,restitution\n1,2,3,1.5\n"),
              HasSubstr("t.csv:2:7: error: 'restitution' of a body must be from 0 to 1, but it is"));
  EXPECT_THAT(errors("x,y,radius,mass,friction\n1,2,3,1,-1\n"),
              HasSubstr("t.csv:2:9: error: 'friction' of a body must be at least 0, but it is \"-1\""));
  EXPECT_THAT(errors(""),
              HasSubstr("t.csv: error: a table of bodies begins with a line that names its columns"));
  EXPECT_THAT(errors(std::string("x,y,radius\n1,2,\0", 16)), HasSubstr("holds a zero byte"));
  EXPECT_THAT(
      Tabled("[[bodies]]\ntable = 'none.csv'\n", "").errors(),
      HasSubstr(
          "s.toml:2:9: error: 'table' in [[bodies]] names the file \"none.csv\", which does not exist"));
  EXPECT_THAT(Tabled("[[bodies]]\nradius = 1\n", "").errors(), HasSubstr("[[bodies]] needs 'table'"));
  EXPECT_THAT(Tabled(scene + "fill = 'purpel'\n", "x,y,radius\n1,2,3\n").errors(),
              HasSubstr("s.toml:3:8: error: 'fill' in [[bodies]] must be a colour"));
  EXPECT_THAT(Tabled(scene + "name = 'a'\n", "x,y,radius\n1,2,3\n").errors(),
              HasSubstr("s.toml:3:8: error: 'name' in [[bodies]] cannot be the same"));
  EXPECT_EQ(Tabled(scene, "x,y,radius\n").load().world.bodies.size(), 0U);
}

/// Neither a wrong value of a row nor one of the row before hides what else is wrong.
TEST(BodyTable, AllThatIsWrongInARowIsToldInOneRun) {
  const std::string errors =
      Tabled("[[bodies]]\ntable = 't.csv'\n", "name,x,y,radius,fill,shape\na,1,2,-3,purpel,circle\n"
                                              "b,1,,3,purpel,circle\nc,z,2,3,red,squar\nd,1,u,3,red,circle\n")
          .errors();
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n') + 1, 7) << errors;
  EXPECT_THAT(errors,
              AllOf(HasSubstr("t.csv:2:7: error: 'radius' of a body must be at least 0, but it is \"-3\""),
                    HasSubstr("t.csv:2:10: error: 'fill' in [[bodies]] must be a colour"),
                    HasSubstr("t.csv:3:1: error: a circle needs 'y', and the cell is empty"),
                    HasSubstr("t.csv:3:8: error: 'fill' in [[bodies]] must be a colour"),
                    HasSubstr("t.csv:4:3: error: 'x' of a body must be a finite number, but it is \"z\""),
                    HasSubstr("t.csv:4:13: error: 'shape' in [[bodies]] must be"),
                    HasSubstr("t.csv:5:5: error: 'y' of a body must be a finite number, but it is \"u\"")));
}

TEST(BodyTable, AnUnknownKeyIsToldOnceAndHidesNoRow) {
  EXPECT_EQ(Tabled("[[bodies]]\ntable = 't.csv'\ncolor = 'red'\n", "x,y,radius\n1,2,-3\n").errors(),
            "2: s.toml:3:1: error: unknown key 'color' in [[bodies]]; did you mean 'fill'?\n"
            "t.csv:2:5: error: 'radius' of a body must be at least 0, but it is \"-3\"");
}

TEST(BodyTable, AHundredThousandBodiesLoadInWellUnderASecond) {
  std::string table = "x,y,radius,vx,vy,restitution,friction,fill\n";
  for (int i = 0; i < 100000; ++i)
    table += fmt::format("{},{},{},{},{},{},{},{}\n", 0.1 * i, 0.2 * i, 1 + i % 5, i % 7, i % 11, 1e-5 * i,
                         2e-5 * i, i % 2 == 0 ? "red" : "blue");
  const Tabled tabled("[[bodies]]\ntable = 't.csv'\n", table);
  const std::clock_t start = std::clock();
  EXPECT_EQ(tabled.load().world.bodies.size(), 100000U);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_LT(seconds, 1.0) << "CPU seconds";
  RecordProperty("cpu_ms", static_cast<int>(seconds * 1000));
}

} // namespace
} // namespace offstage::test
