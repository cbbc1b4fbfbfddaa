#include "unit/scene/image_files.h"
#include "unit/scene/scene_files.h"

#include <transillum/scene/brdf.h>

#include <OpenImageIO/imageio.h>

namespace transillum {

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class ReadObj : public SceneFiles {
protected:
    /// The material of a square that names `m` of a library with these statements.
    Material material_of(const std::string& statements) {
        write("m.mtl", "newmtl m\n" + statements);
        return load("x.obj", "mtllib m.mtl\n" + square + "usemtl m\nf 1 2 3 4\n").materials.at(0);
    }
    void expect_material_refused(const std::string& statements,
                                 const std::vector<std::string>& parts) {
        write("m.mtl", "newmtl m\n" + statements);
        expect_refused("x.obj", "mtllib m.mtl\n" + square + "usemtl m\nf 1 2 3 4\n", parts);
    }
};

TEST_F(ReadObj, KeepsPolygonsWhole) {
    const Scene scene = load("x.obj", square + "v 0.1 0.5 0\nf 1 2 3 4 5\nf 1/ 2 3\n");
    ASSERT_EQ(scene.polygons.size(), 2u);
    EXPECT_EQ(scene.polygons[0].corner_count, 5u);
    EXPECT_EQ(scene.polygons[1].source_face, 1u);
    EXPECT_EQ(corners_of(scene, 0)[4], glm::dvec3(0.1, 0.5, 0)) << "in double precision";
    EXPECT_TRUE(scene.materials[0].back_reflects);
    EXPECT_FALSE(scene.materials[0].back_emits);
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ReadObj, CountsNegativeIndicesFromTheEndSoFar) {
    const Scene scene = load("x.obj", square + "f -4 -3 -1\nv 5 5 5\nf -1 -5 -4\n");
    EXPECT_EQ(corners_of(scene, 0)[0], glm::dvec3(0, 0, 0));
    EXPECT_EQ(corners_of(scene, 0)[2], glm::dvec3(0, 1, 0));
    EXPECT_EQ(corners_of(scene, 1)[0], glm::dvec3(5, 5, 5));
}

TEST_F(ReadObj, AllowsFacesBeforeTheirVertices) {
    EXPECT_EQ(corners_of(load("x.obj", "f 1 2 3\n" + square), 0)[1], glm::dvec3(1, 0, 0));
}

TEST_F(ReadObj, TakesCamerasFromComments) {
    const Scene scene = load(
        "x.obj", "# camera front 1 2 3  4 5 6  0 1 0 39.5\n# camera settings follow\n" + square +
                     "# camera of 1 2 3  4 5 6  0 1 0 then 7\nf 1 2 3\n"
                     "# camera top 0 9 0  0 0 0  0 0 -1 60\r\n");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_EQ(scene.cameras[0].eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.cameras[0].look_at, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.cameras[0].up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.cameras[0].vertical_fov, 39.5);
    EXPECT_EQ(scene.cameras[1].name, "top");
    EXPECT_TRUE(monitor_.warnings.empty());
}

TEST_F(ReadObj, LeavesOutImpossibleCameras) {
    for (const std::string numbers :
         {"0 0 0 0 0 0 0 1 0 45", "0 0 0 0 1 0 0 1 0 45", "0 0 0 1 0 0 0 1 0 180"}) {
        monitor_.warnings.clear();
        EXPECT_TRUE(
            load("x.obj", square + "# camera c " + numbers + "\nf 1 2 3\n").cameras.empty());
        ASSERT_EQ(monitor_.warnings.size(), 1u) << numbers;
        EXPECT_NE(monitor_.warnings[0].find("x.obj:5: camera 'c'"), std::string::npos);
    }
}

TEST_F(ReadObj, JoinsContinuedLines) {
    for (const std::string end : {"\n", "\r\n"}) {
        const Scene scene = load("x.obj", square + "f 1 2 \\" + end + "3\\" + end + " 4" + end);
        EXPECT_EQ(scene.polygons.at(0).corner_count, 4u);
    }
    expect_refused("x.obj", square + "f 1 2 \\\r\n3\nf 1 2 9\n",
                   {"x.obj:7: face names vertex 9 of 4"});
}

TEST_F(ReadObj, ReadsTabsCommentsAndPlusSigns) {
    const Scene scene =
        load("x.obj", "v\t0 0\t0 # origin\nv +1 0 0\r\nv 1 1e0 0\n#f 1 1 1\n  f\t1 2 3 # done");
    EXPECT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(corners_of(scene, 0)[1], glm::dvec3(1, 0, 0));
}

TEST_F(ReadObj, KeepsTextureCoordinates) {
    const Scene scene = load("x.obj", square + "vt 0.25 0.5\nvt 1 1\nf 1/1 2/2 3/-1\nf 1 2 3\n");
    ASSERT_EQ(scene.uvs.size(), scene.corners.size());
    EXPECT_EQ(scene.uvs[0], glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(scene.uvs[2], glm::vec2(1.0f, 0.0f)) << "v upwards in the file";
    EXPECT_TRUE(load("y.obj", square + "f 1 2 3\n").uvs.empty());
}

TEST_F(ReadObj, NamesObjectsByOElseByG) {
    const Scene by_o =
        load("x.obj", square + "o a b\ng g1\nf 1 2 3\ng g2\nf 1 2 3\no c\nf 1 2 3\n");
    EXPECT_EQ(by_o.objects, (std::vector<std::string>{"a b", "c"}));
    EXPECT_EQ(by_o.polygons[1].object, 0u);
    EXPECT_EQ(by_o.polygons[2].object, 1u);
    const Scene by_g = load("y.obj", square + "g unused\ng g1\nf 1 2 3\ng g2\nf 1 2 3\n");
    EXPECT_EQ(by_g.objects, (std::vector<std::string>{"g1", "g2"}));
    EXPECT_EQ(load("z.obj", square + "f 1 2 3\n").objects, std::vector<std::string>{"z"});
}

TEST_F(ReadObj, LeavesOutLinesAndPoints) {
    EXPECT_EQ(load("x.obj", square + "l 1 2\np 1\nf 1 2 3\n").polygons.size(), 1u);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "2 points, lines"));
}

TEST_F(ReadObj, RefusesWhatIsWrongAndNamesTheLine) {
    expect_refused("x.obj", square + "f 1 2 5\n",
                   {"x.obj:5: face names vertex 5 of 4; accepted: 1 to 4 or -4 to -1"});
    expect_refused("x.obj", square + "f 1 2 -5\n", {"x.obj:5: face names vertex -5 of 4"});
    expect_refused("x.obj", square + "f 0 1 2\n", {"x.obj:5: face names vertex 0 of 4"});
    expect_refused("x.obj", "f 1 2 3\n", {"x.obj:1: face names vertex 1 of 0; accepted: none"});
    expect_refused("x.obj", square + "f 1/1 2/1 3/1\n",
                   {"x.obj:5: face names texture coordinate 1 of 0"});
    expect_refused("x.obj", square + "f 1//2 2//1 3//1\nvn 0 0 1\n",
                   {"x.obj:5: face names normal 2 of 1"});
    expect_refused("x.obj", square + "f 1 2\n",
                   {"x.obj:5: face has 2 corners; accepted: 3 or more"});
    expect_refused("x.obj", square + "f 1 2 3.5\n", {"x.obj:5: '3.5' found; accepted: an integer"});
    expect_refused("x.obj", square + "f 1 2 3/1/1/1\n", {"x.obj:5: corner '3/1/1/1'"});
    expect_refused("x.obj", "v 0 0 XXX0.5\n",
                   {"x.obj:1: 'XXX0.5' found; accepted: a finite number"});
    expect_refused("x.obj", "v 0 0 nan\n", {"x.obj:1: 'nan'"});
    expect_refused("x.obj", "v 0 -inf 0\n", {"x.obj:1: '-inf'"});
    expect_refused("x.obj", "v 0 1e999 0\n", {"x.obj:1: '1e999'"});
    expect_refused("x.obj", "v 0 0.5\n", {"x.obj:1: 'v' with 2 numbers"});
    expect_refused("x.obj", std::string("v 0 0 0\n\x01\x02\x00\xff garbage\n", 21),
                   {"x.obj:2: statement '??"});
    expect_refused("x.obj", square, {"x.obj: no polygon found"});
}

TEST_F(ReadObj, ReadsMaterials) {
    const Material m =
        material_of("Kd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 50\nKe 7 8 9 # bright\nillum 2\n");
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.diffuse, Spectrum(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.specular, Spectrum(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(m.lobe, Lobe::max_phong);
    EXPECT_EQ(m.shininess, 50.0f);
    EXPECT_EQ(m.emission, Spectrum(7.0f, 8.0f, 9.0f));
    EXPECT_EQ(m.opacity, 1.0f);
    EXPECT_EQ(material_of("Kd 0.25\n").diffuse, Spectrum(0.25f)) << "one number is grey";
}

TEST_F(ReadObj, TakesKsOnlyWithHighlights) {
    EXPECT_EQ(material_of("Kd 0 0 0\nKs 1 1 1\nNs 9\nillum 1\n").specular, Spectrum(0.0f));
    EXPECT_EQ(material_of("Kd 0 0 0\nKs 1 1 1\nNs 9\nillum 1\n").shininess, 0.0f);
    EXPECT_EQ(material_of("Kd 0 0 0\nKs 1 1 1\nNs 9\nillum 1\n").lobe, Lobe::none);
    EXPECT_EQ(material_of("Kd 1 1 1\nKs 0 0 0\nNs 9\nillum 2\n").lobe, Lobe::none);
    EXPECT_EQ(material_of("Kd 0 0 0\nillum 2\nKs 1 1 1\n").specular, Spectrum(1.0f));
    EXPECT_EQ(material_of("Kd 0 0 0\nKs 1 1 1\n").specular, Spectrum(1.0f));
}

TEST_F(ReadObj, SaysWhichShininessItTakesWhereNsIsMissingOrTooLow) {
    EXPECT_EQ(material_of("Kd 0 0 0\nKs 1 1 1\n").shininess, 1.0f);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "material 'm' has Ks and no Ns; 1 is taken"));
    EXPECT_EQ(brdf_of(material_of("Kd 0 0 0\nKs 1 1 1\nNs 0.5\n")).shininess, 1.0f);
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "has Ks and an Ns of 0.5; 1 is taken"));
}

TEST_F(ReadObj, ReadsOpacityFromDOrTr) {
    EXPECT_EQ(material_of("Kd 0 0 0\nd 0.25\n").opacity, 0.25f);
    EXPECT_EQ(material_of("Kd 0 0 0\nTr 0.25\n").opacity, 0.75f);
    EXPECT_EQ(material_of("Kd 0 0 0\nd -halo 0.5\n").opacity, 0.5f);
    EXPECT_EQ(material_of("Kd 0 0 0\nTr 0.9\nd 1\n").opacity, 1.0f);
}

TEST_F(ReadObj, AcceptsLobesThatTogetherReflectMoreThanAll) {
    EXPECT_EQ(material_of("Kd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\n").albedo(),
              Spectrum(0.8f) + Spectrum(0.5f));
}

TEST_F(ReadObj, RefusesImpossibleMaterials) {
    expect_material_refused("Kd 0.5 1.5 0.5\n", {"m.mtl:2: Kd is 1.5; accepted: 0 to 1"});
    expect_material_refused("\nKs -0.1 0 0\n", {"m.mtl:3: Ks is -0.1; accepted: 0 to 1"});
    expect_material_refused("Ke 1 1 -1\n", {"m.mtl:2: Ke is -1; accepted: 0 or more"});
    expect_material_refused("Kd 0.5 nan 0.5\n", {"m.mtl:2: 'nan'"});
    expect_material_refused("d 1.5\n", {"m.mtl:2: d is 1.5"});
    expect_material_refused("Ns\n", {"m.mtl:2: 'Ns' has no value"});
    expect_material_refused("Kd 0.5 0.5\n", {"m.mtl:2", "accepted: one or three numbers"});
    write("n.mtl", "Kd 1 1 1\n");
    expect_refused("x.obj", "mtllib n.mtl\n", {"n.mtl:1: 'Kd' found before any material"});
}

TEST_F(ReadObj, TakesTheDefaultMaterialWhereNoneIsDefined) {
    const Scene scene =
        load("x.obj", "mtllib none.mtl\n" + square + "usemtl \nf 1 2 3\nusemtl wood\nf 1 2 3\n");
    EXPECT_TRUE(
        monitor_.any_names(monitor_.warnings, "x.obj:1: material library 'none.mtl' is not there"));
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_EQ(scene.materials[1].name, "wood");
    EXPECT_EQ(scene.polygons[1].material, 1u);

    write("m.mtl", "newmtl m\nKd 1 1 1\n");
    load("y.obj", "mtllib m.mtl\n" + square + "usemtl other\nf 1 2 3\n");
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "material 'other' is not defined"));
}

TEST_F(ReadObj, TakesTheLinearMeanOfATexture) {
    // sRGB 255 is 1, 0 is 0; 188 is 0.5028864580 by the formula of IEC 61966-2-1
    write_image<std::uint8_t>(folder_ / "my map.png", {2, 1, 3}, {255, 188, 0, 0, 188, 0});
    const Material m = material_of("Kd 0.5 1 1\nmap_Kd -s 1 1 1 -clamp on my map.png\n");
    EXPECT_NEAR(m.diffuse.r, 0.25, 1e-6);
    EXPECT_NEAR(m.diffuse.g, 0.5028864580, 1e-6);
    EXPECT_EQ(m.diffuse.b, 0.0f);
}

TEST_F(ReadObj, DoesNotDarkenATextureByItsAlpha) {
    write_image<std::uint8_t>(folder_ / "half.png", {1, 1, 4}, {255, 255, 255, 128});
    EXPECT_NEAR(material_of("map_Kd half.png\n").diffuse.r, 1.0, 1e-6);
}

TEST_F(ReadObj, RefusesADamagedTextureOfAUsedMaterialOnly) {
    write("damaged.png", "no image");
    expect_material_refused("map_Kd damaged.png\n", {"damaged.png", "cannot be read as an image"});
    write("m.mtl", "newmtl unused\nmap_Kd damaged.png\n");
    EXPECT_EQ(load("x.obj", "mtllib m.mtl\n" + square + "f 1 2 3\n").polygons.size(), 1u);
}

TEST_F(ReadObj, ReportsWhatItDoesNotHonour) {
    material_of("Kd 0.5 0.5 0.5\nTf 0.1 0.1 0.1\nmap_Bump rough.png\nKa 1 1 1\n");
    EXPECT_TRUE(monitor_.any_names(monitor_.notes, "m.mtl:3: material 'm': 'Tf' is not honoured"));
    EXPECT_TRUE(monitor_.any_names(monitor_.warnings, "'map_Bump' is not honoured"));
    EXPECT_FALSE(monitor_.any_names(monitor_.notes, "'Ka'"));
}

}  // namespace

}  // namespace transillum
