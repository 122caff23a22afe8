"""The image of packaging/Containerfile: built by buildah on a base that debootstrap made, and run, without a registry and a network."""
import json
import subprocess

import debian

BASE, IMAGE = "localhost/ripstop-base", "localhost/ripstop-test"
ISOLATED = ("--isolation", "chroot")  # also within another container


def buildah(*words, output=False):
    print("-- buildah", *words, flush=True)
    done = subprocess.run(["unshare", "--net", "buildah", *map(str, words)], check=True, text=True, stdout=subprocess.PIPE if output else None)
    return done.stdout.strip() if output else ""


def make_base(root):
    """The image of an empty root."""
    container = buildah("from", "scratch", output=True)
    buildah("copy", "--quiet", container, root, "/")
    buildah("commit", "--quiet", "--rm", container, BASE)


def make_image(archive):
    """The image of the Containerfile with a portable archive, whose folder is the context. Returns its size [MB]."""
    buildah("build", *ISOLATED, "--pull=never", "--quiet", "--build-arg", f"BASE={BASE}", "-f", debian.ROOT / "packaging/Containerfile",
            "-t", IMAGE, archive.parent)
    image = json.loads(buildah("inspect", "--type", "image", IMAGE, output=True))["OCIv1"]["config"]
    if image["Entrypoint"] != ["ripstop"] or image["WorkingDir"] != "/work":
        raise SystemExit(f"{IMAGE} does not start ripstop in /work: {image}")
    return json.loads(buildah("images", "--json", IMAGE, output=True))[0]["size"].removesuffix(" MB")


def run_in(work, command):
    """Runs the program of the image with `work` as /work."""
    container = buildah("from", "--pull=never", IMAGE, output=True)
    try:
        buildah("run", *ISOLATED, "--volume", f"{work}:/work", container, "--", "sh", "-c", command)
    finally:
        buildah("rm", container)


def remove():
    for image in (IMAGE, BASE):
        subprocess.run(["buildah", "rmi", "--force", image], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
