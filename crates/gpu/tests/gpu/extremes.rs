//! Ends of ranges, where numbers of single precision would overflow, and the last generation.

use catoptric_scene::{Scene, read};

use crate::common::{card, stage_of};
use crate::parity::{compare, fault};

fn scene(text: &str) -> Scene {
    read(&format!("format = \"catoptric/1\"\n{text}\n")).into_result().unwrap().value
}

#[test]
fn light_stays_finite_on_a_card() {
    let Some(card) = card("light_stays_finite_on_a_card") else { return };
    let scenes = [
        "[[bodies]]\nmaterial={model=\"coated\",color=[1,1,1],ior=0.01}\n[[lights]]",
        "[camera]\nposition=[0.1,0,0]\ntarget=[1,0,0]\n[tracing]\ngenerations=64\n\
         [[bodies]]\nmaterial={reflection=1e6,color=[1e6,0,1],specular=1e6}\n\
         [[lights]]\nposition=[0,0.2,0]\nintensity=1e6\ncolor=[1e6,0,1]\nfalloff=\"inverse-square\"",
        "[[bodies]]\nmaterial={model=\"mirror\",roughness=1e-9,reflection=1e6,color=[1e6,0,1]}\n\
         [[bodies]]\nshape=\"plane\"\nmaterial={model=\"dielectric\",roughness=1e-5,ior=100}\n[[lights]]\nradius=1e-9",
        "[[bodies]]\nmaterial={transmission=1e6,tint=[1e6,0,1],ior=1}\n\
         [[bodies]]\nposition=[0.5,0,0]\nmaterial={transmission=1e6,tint=[0,1e6,1],ior=1}\n\
         [[bodies]]\nshape=\"plane\"\nposition=[0,-1,0]\n[[lights]]\nintensity=1e6",
    ];
    for (number, text) in scenes.into_iter().enumerate() {
        let compared = compare(&card, &stage_of(&scene(text)), 2);
        for (name, picture) in [("the CPU", &compared.cpu.0), ("the GPU", &compared.gpu.0)] {
            let bad = picture.pixels().iter().flatten().find(|part| !part.is_finite());
            assert_eq!(bad, None, "scene {number} on {name}");
        }
    }
}

#[test]
fn invisible_bodies_are_passed_at_every_limit_and_hollow_ones_shade_as_on_the_cpu() {
    let name = "invisible_bodies_are_passed_at_every_limit_and_hollow_ones_shade_as_on_the_cpu";
    let Some(card) = card(name) else { return };
    let bodies = "[camera]\nposition=[0.5,1.5,5]\n[[lights]]\n\
        [[bodies]]\nshape=\"plane\"\nposition=[0,-1,0]\nmaterial={checker={}}\n\
        [[bodies]]\nmaterial={model=\"dielectric\",ior=1.0,attenuation_color=[0.9,0.5,0.2]}\n\
        [[bodies]]\nradius=0.9\nmaterial={model=\"dielectric\",ior=1.0}\n\
        [[bodies]]\nposition=[1.2,0.3,0.4]\nradius=0.7\n\
        material={model=\"dielectric\",ior=1.0,dispersion=true,attenuation_color=[0.2,0.6,0.9]}\n\
        [[bodies]]\nshape=\"cube\"\nposition=[-1.5,0,0]\n\
        material={model=\"dielectric\",ior=1.5,attenuation_color=[0.3,0.6,0.4]}\n\
        [[bodies]]\nshape=\"cube\"\nposition=[-1.5,0,0]\nsize=0.8\nmaterial={model=\"dielectric\",ior=1.0}";
    for generations in [1, 2, 4] {
        let render_scene = stage_of(&scene(bodies)).with_generations(generations);
        let compared = compare(&card, &render_scene, 1);
        assert_eq!(fault(&format!("{generations} generations"), &compared), None);
    }
    // Phong's glass of index 1, by the shaders of plain materials.
    let plain = "[camera]\nposition=[0.5,1.5,5]\n[[lights]]\n[[bodies]]\nshape=\"plane\"\nposition=[0,-1,0]\n\
        [[bodies]]\nmaterial={transmission=0.9,specular=0.1,ior=1.0}\n\
        [[bodies]]\nposition=[1,0,0]\nmaterial={transmission=0.8,reflection=0.2,ior=1.0}";
    for generations in [1, 2] {
        let render_scene = stage_of(&scene(plain)).with_generations(generations);
        assert_eq!(
            fault(&format!("plain, {generations} generations"), &compare(&card, &render_scene, 1)),
            None
        );
    }
}
