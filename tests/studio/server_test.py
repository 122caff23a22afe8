#!/usr/bin/env python3
"""The server of Studio under requests of its page and of others: it answers only those with its token, Host and Origin, and reads and
writes only in its folder.

    server_test.py RIPSTOP"""
import base64
import http.client
import json
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from studio import ROOT, Studio

PROGRAM = sys.argv[1]
DEADLINE = time.monotonic() + 850  # of all tests; they wait for states, whatever the speed of the machine
CASE = (ROOT / "examples/flat-circular/case.toml").read_text().replace("cloth_nodes = 12000", "cloth_nodes = 1000  # coarse")


class Server(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-studio-test-"))
        self.folder = self.place / "designs"
        self.folder.mkdir()
        (self.place / "secret.toml").write_text("title = 'secret'\n")
        (self.folder / "a.toml").write_text(CASE)
        (self.folder / "link.toml").symlink_to(self.place / "secret.toml")
        self.studio = Studio(PROGRAM, self.folder)

    def tearDown(self):
        if self.studio.process.poll() is None:
            self.studio.end()
        shutil.rmtree(self.place)

    def read(self):
        return self.studio.get("/api/case", file="a.toml")[1]

    def test_the_page_needs_token_host_and_origin(self):
        s = self.studio
        self.assertEqual(s.request("GET", f"/?token={s.token}", without=["X-Ripstop-Token"])[0], 200)
        for path in ("/", "/?token=", f"/?token={s.token[:-1]}0x", f"/?token={s.token}0"):
            self.assertEqual(s.request("GET", path, without=["X-Ripstop-Token"])[0], 403, path)
        for headers in ({"X-Ripstop-Token": "0" * 32}, {"Host": f"evil.example:{s.port}"}, {"Host": "127.0.0.1"}, {"Origin": "http://evil.example"},
                        {"Origin": "null"}, {"Origin": f"https://127.0.0.1:{s.port}"}, {"Origin": f"http://127.0.0.1:{s.port + 1}"}):
            for method, path in (("GET", "/api/folder"), ("GET", "/api/case?file=a.toml"), ("POST", "/api/case/create")):
                body = {"file": "b.toml", "family": "conical"} if method == "POST" else None
                self.assertEqual(s.request(method, path, body, headers)[0], 403, headers)
        self.assertEqual(s.request("GET", "/api/folder", without=["X-Ripstop-Token"])[0], 403)
        self.assertEqual(s.request("GET", f"/api/folder?token={s.token}", without=["X-Ripstop-Token"])[0], 403)
        self.assertEqual(s.request("GET", "/api/folder", without=["Host"])[0], 403)
        self.assertEqual(s.request("GET", "/api/folder", headers={"Origin": f"http://127.0.0.1:{s.port}"})[0], 200)
        self.assertFalse((self.folder / "b.toml").exists())

    def test_the_page_permits_no_other_address(self):
        _, headers, page = self.studio.request("GET", f"/?token={self.studio.token}")
        policy = headers["Content-Security-Policy"]
        for part in ("default-src 'none'", "connect-src 'self'", "form-action 'none'", "frame-ancestors 'none'", "base-uri 'none'"):
            self.assertIn(part, policy)
        self.assertNotIn("http", policy)
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")
        self.assertNotIn(self.studio.token.encode(), page)
        other = self.studio.request("GET", f"/?token={self.studio.token}")[1]["Content-Security-Policy"]
        self.assertNotEqual(policy, other)  # the nonce

    def test_nothing_outside_of_the_folder_is_read_or_written(self):
        s = self.studio
        for name in ("../secret.toml", "..%2Fsecret.toml", "/etc/passwd", "link.toml", "a.toml/../../secret.toml", "", ".", "..", "a.toml\0", "-a.toml", "a b.toml"):
            for path in ("/api/case", "/api/shape", "/api/pattern", "/api/load"):
                status, answer = s.get(path, file=name, mass=1, speed=20, view="test", nodes=1000)
                self.assertEqual((status, list(answer)), (400, ["error"]), (path, name))
            self.assertEqual(s.post("/api/case/create", file=name, family="conical")[0], 400, name)
            self.assertEqual(s.post("/api/case/create", file="new.toml", family=name)[0], 400, name)
            self.assertEqual(s.post("/api/jobs/start", name="x", command="steady", case=name, options={})[0], 400, name)
            self.assertEqual(s.get("/api/report", run=name)[0], 400, name)
            if name != "link.toml":  # a name that a run may have
                self.assertEqual(s.post("/api/jobs/start", name=name, command="steady", case="a.toml", options={})[0], 400, name)
                self.assertEqual(s.get("/api/log", name=name)[0], 400, name)
            self.assertEqual(s.get("/api/export", run=name, format="rocketpy")[0], 400, name)
            for path, more in (("/api/progress", {"name": name}), ("/api/shape", {"view": name, "file": "a.toml", "nodes": 1000}), ("/api/shape/later", {"view": name, "number": 1})):
                if name != "link.toml":
                    self.assertEqual(s.get(path, **more)[0], 400, (path, name))
            self.assertEqual(s.post("/api/case/copy", file="new.toml", **{"from": name})[0], 400, name)
            if name != "link.toml":
                self.assertEqual(s.post("/api/material", bench={"name": name, "kind": "line"}, records=[{"name": "a.csv", "base64": ""}], save=True)[0], 400, name)
                self.assertEqual(s.post("/api/material", bench={"name": "x", "kind": "line"}, records=[{"name": name, "base64": ""}], save=True)[0], 400, name)
            self.assertEqual(s.post("/api/jobs/start", name="x", command="load", case="a.toml", options={"--steady": name})[0], 400, name)
        for path in ("/../secret.toml", "/%2e%2e/secret.toml", "/a.toml", "/runs"):
            self.assertEqual(s.request("GET", path)[0], 404, path)
        self.assertEqual(s.request("GET", "/view?key=")[0], 403)
        self.assertEqual([file.name for file in self.place.iterdir() if file.name != "designs"], ["secret.toml"])
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["a.toml", "link.toml", "runs"])

    def test_links_in_the_folder_lead_nowhere(self):
        other = self.place / "other"
        other.mkdir()
        report = "<!doctype html>\n<!-- Ripstop report -->\nsecret"
        (other / "report.html").write_text(report)
        (other / "iterations.csv").write_text("iteration,drag_n\n1,10\n")
        (self.folder / "runs/linked").symlink_to(other)
        (self.folder / "runs/own").mkdir()
        (self.folder / "runs/own/report.html").symlink_to(other / "report.html")
        (self.folder / "linked.html").symlink_to(other / "report.html")
        (self.folder / "materials").symlink_to(other)
        s = self.studio
        for run in ("linked", "own"):
            self.assertEqual(s.get("/api/report", run=run)[0], 400, run)
            self.assertEqual(s.get("/api/export", run=run, format="report")[0], 400, run)
            self.assertEqual(s.get("/api/progress", name=run), (200, {"plots": []}), run)
            self.assertEqual(s.post("/api/jobs/start", name=run, command="steady", case="a.toml", options={})[0], 400, run)
        before = sorted(file.name for file in other.iterdir())
        status, answer = s.post("/api/material", bench={"name": "x", "kind": "line"}, records=[{"name": "a.csv", "base64": ""}], save=True)
        self.assertEqual(status, 400)
        self.assertIn("leads out of the folder", answer["error"])
        self.assertEqual(sorted(file.name for file in other.iterdir()), before)
        s.end()
        shutil.rmtree(self.folder / "runs")
        (self.folder / "runs").symlink_to(other)
        with self.assertRaises(RuntimeError):
            Studio(PROGRAM, self.folder)
        self.assertEqual(sorted(file.name for file in other.iterdir()), before)

    def test_ten_thousand_requests_leave_the_memory_bounded(self):
        s = self.studio
        requests = [("GET", "/", None, 403), ("GET", "/api/folder", None, 200), ("GET", "/api/jobs", None, 200), ("GET", "/api/case?file=..", None, 400),
                    ("GET", "/nothing", None, 404), ("POST", "/api/case/write", b"[" * 1000, 400), ("POST", "/api/case/change", b"{}", 400), ("GET", "/view?key=x", None, 403)]
        connection = http.client.HTTPConnection("127.0.0.1", s.port, timeout=60)

        def send(count):
            for i in range(count):
                method, path, body, expected = requests[i % len(requests)]
                connection.request(method, path, body, {"X-Ripstop-Token": s.token, "Content-Type": "application/json"})
                answer = connection.getresponse()
                answer.read()
                self.assertEqual(answer.status, expected, path)

        send(1000)
        before = s.memory()
        send(9000)
        self.assertLess(s.memory() - before, 16 << 20)
        connection.close()

    def test_changes_of_the_shape_leave_the_memory_bounded(self):
        for pressure in range(100, 110):
            self.assertEqual(self.studio.shape(file="a.toml", nodes=1000, pressure=pressure)[0], 200)
        before = self.studio.memory()
        for pressure in range(100, 140):
            self.assertEqual(self.studio.shape(view=f"view-{pressure % 7}", file="a.toml", nodes=1000, pressure=pressure)[0], 200)
        self.assertLess(self.studio.memory() - before, 64 << 20)

    def test_a_full_disk_is_a_message_and_no_file_is_lost(self):
        self.studio.end()
        limit = 6000  # [bytes] of a file

        def full():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        self.studio = s = Studio(PROGRAM, self.folder, before=full)
        before = self.read()
        status, answer = s.post("/api/case/write", file="a.toml", version=before["version"], text=CASE + "# filling\n" * limit)
        self.assertEqual(status, 507, answer)
        self.assertIn("a.toml", answer["error"])
        self.assertEqual((self.folder / "a.toml").read_text(), CASE)
        self.assertEqual(s.post("/api/jobs/start", name="full", command="steady", case="a.toml", options={"--grid": "20,20,30"})[0], 200)
        self.assertEqual(self.wait_for("full", ["failed"]), "failed")
        message = next(job["message"] for job in s.get("/api/jobs")[1] if job["name"] == "full")
        self.assertIn("runs/full", message)
        self.assertEqual([file.name for file in self.folder.iterdir() if file.name.endswith(".tmp")], [])
        status, answer = s.post("/api/case/write", file="a.toml", version=before["version"], text=CASE + "# a remark\n")
        self.assertEqual(status, 200, answer)

    def test_oversized_and_malformed_requests_are_refused(self):
        s = self.studio
        try:
            self.assertEqual(s.request("POST", "/api/case/write", b"{" + b" " * (3 << 20))[0], 413)
        except ConnectionError:
            pass  # refused before all of it was sent
        self.assertEqual(s.request("POST", "/api/case/write", b"{}", {"Content-Length": "99999999999999999999"}, ())[0], 413)
        self.assertEqual(s.request("POST", "/api/material", b"{}", {"Content-Length": str(64 << 20)}, ())[0], 413)
        for request in ({}, {"bench": 3, "records": []}, {"bench": {"name": "x"}, "records": "x"}, {"bench": {"name": "x"}, "records": [{"name": "a.csv", "base64": "*"}]},
                        {"bench": {"name": "x", "out": "y"}, "records": [{"name": "a.csv", "base64": ""}]}, {"bench": {"name": "x", "kind": {}}, "records": [{"name": "a.csv", "base64": ""}]},
                        {"bench": {"name": "x", "kind": "line\n[[coupon]]\nfile = '/etc/passwd'"}, "records": [{"name": "a.csv", "base64": ""}]}):
            status, answer = s.post("/api/material", **request)
            self.assertEqual((status, list(answer)), (400, ["error"]), request)
        for number in ("", "-1", "1e9", "99999999999", "x"):
            self.assertEqual(s.get("/api/shape/later", view="a", number=number)[0], 400, number)
        self.assertEqual(s.request("POST", "/api/case/write", b"5\r\nhello\r\n0\r\n\r\n", {"Transfer-Encoding": "chunked"})[0], 411)
        self.assertEqual(s.request("POST", "/api/case/write", b"{}", {"Content-Encoding": "gzip"})[0], 411)
        self.assertEqual(s.request("POST", "/api/case/write", b"a=b", {"Content-Type": "application/x-www-form-urlencoded"})[0], 415)
        for body in (b"", b"{", b"[]", b"3", b"\xff\xfe", b'{"file": 3}', b'{"file": "a.toml"}', b"[" * 100000):
            self.assertEqual(s.request("POST", "/api/case/write", body)[0], 400, body[:20])
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertIn(s.request(method, "/api/folder")[0], (400, 405), method)
        for raw in (b"\r\n\r\n", b"GET\r\n\r\n", b"\0" * 5000, b"GET / HTTP/9.9\r\n\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", s.port), timeout=10) as connection:
                try:
                    connection.sendall(raw)
                    connection.shutdown(socket.SHUT_WR)
                    self.assertNotIn(b" 200 ", connection.recv(200))
                except ConnectionError:
                    pass
        self.assertEqual(s.get("/api/folder")[0], 200)
        self.assertEqual((self.folder / "a.toml").read_text(), CASE)

    def test_only_the_loopback_interface_listens(self):
        listening = []  # addresses as the kernel writes them, bytes of IPv4 in the order of the machine
        for table in ("/proc/net/tcp", "/proc/net/tcp6"):
            for row in pathlib.Path(table).read_text().splitlines()[1:]:
                local, state = row.split()[1], row.split()[3]
                address, port = local.split(":")
                if state == "0A" and int(port, 16) == self.studio.port:
                    listening.append(address)
        self.assertEqual(listening, ["0100007F"])

    def test_a_change_keeps_comments_and_a_conflict_changes_nothing(self):
        before = self.read()
        status, after = self.studio.post("/api/case/change", file="a.toml", version=before["version"], changes={"parachute.mesh.cloth_nodes": 1200})
        self.assertEqual(status, 200)
        self.assertEqual((self.folder / "a.toml").read_text(), CASE.replace("cloth_nodes = 1000", "cloth_nodes = 1200"))
        self.assertEqual(after["check"]["case"]["parachute"]["mesh"]["cloth_nodes"], 1200)
        status, answer = self.studio.post("/api/case/change", file="a.toml", version=before["version"], changes={"parachute.gores": 14})
        self.assertEqual(status, 409)
        self.assertIn("has changed", answer["error"])
        status, undone = self.studio.post("/api/case/write", file="a.toml", version=after["version"], text=before["text"])
        self.assertEqual((status, undone["version"]), (200, before["version"]))
        self.assertEqual((self.folder / "a.toml").read_text(), CASE)

    def test_problems_name_their_key(self):
        before = self.read()
        self.assertEqual(before["check"]["problems"], [])
        _, after = self.studio.post("/api/case/change", file="a.toml", version=before["version"], changes={"parachute.gores": -1, "title": "</script><b>"})
        self.assertFalse(after["check"]["valid"])
        self.assertEqual([problem["key"] for problem in after["check"]["problems"]], ["parachute.gores"])
        self.assertEqual(json.loads(after["written"]["title"]), "</script><b>")
        status, broken = self.studio.post("/api/case/write", file="a.toml", version=after["version"], text="[parachute\n")
        self.assertEqual((status, broken["written"], broken["check"]["problems"][0]["line"]), (200, None, 1))

    def test_numbers_are_those_of_the_command_line(self):
        load = self.studio.get("/api/load", file="a.toml", mass=2.4, speed=20)[1]
        subprocess.run([PROGRAM, "load", str(self.folder / "a.toml"), "--mass", "2.4", "--speed", "20", "--out", str(self.place / "load")], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(load, json.loads((self.place / "load/result.json").read_text()))
        shape = self.studio.shape(file="a.toml", nodes=1000, pressure=100)[1]
        self.assertTrue(shape["result"]["converged"])
        self.assertEqual(shape["result"]["pressure_pa"], 100)
        subprocess.run([PROGRAM, "fabric", str(self.folder / "a.toml"), "--pressure", "100", "--out", str(self.place / "look")], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        printed = json.loads((self.place / "look/result.json").read_text())
        for result in (printed, shape["result"]):
            del result["wall_time_s"]
        self.assertEqual(shape["result"], printed)
        coarse = self.studio.get("/api/shape", view="test", file="a.toml", nodes=500, pressure=100)[1]
        while "result" not in coarse or not coarse["result"]["converged"]:
            coarse = self.studio.get("/api/shape/later", view="test", number=coarse["number"])[1]
        refined = self.studio.get("/api/shape/later", view="test", number=coarse["number"])[1]
        while not refined["done"]:
            refined = self.studio.get("/api/shape/later", view="test", number=coarse["number"])[1]
        self.assertLess(coarse["result"]["nodes"], refined["result"]["nodes"])
        del refined["result"]["wall_time_s"]
        self.assertEqual(refined["result"], printed)
        self.assertEqual(shape["shape"]["frames"][0]["points"]["n"], 3 * shape["result"]["nodes"])
        pattern = self.studio.get("/api/pattern", file="a.toml")[1]
        self.assertEqual([piece["name"] for piece in pattern["pieces"]], ["gore"])
        for pressure in ("x", "-1", "1e999", "nan", "1;ls", "[]"):
            self.assertEqual(self.studio.shape(file="a.toml", nodes=1000, pressure=pressure)[0], 400, pressure)
        for nodes in ("x", "-1", "1e9", "1000\ntitle='x'"):
            self.assertEqual(self.studio.shape(file="a.toml", nodes=nodes)[0], 400, nodes)
        for parameters in ({"mass": "x"}, {"mass": "1e999"}, {"mass": "-1"}, {"mass": "1;ls"}, {"speed": "nan"}):
            self.assertEqual(self.studio.get("/api/load", **{"file": "a.toml", "mass": 2.4, "speed": 20, **parameters})[0], 400, parameters)

    def test_a_new_case_comes_from_a_family_or_from_mass_and_rate(self):
        families = self.studio.get("/api/folder")[1]["families"]
        for family in families:
            status, case = self.studio.post("/api/case/create", file=f"{family}.toml", family=family)
            self.assertEqual((status, case["check"].get("problems")), (200, []), family)
        status, case = self.studio.post("/api/case/size", file="sized.toml", family="conical", mass=2.4, rate=5, speed=20, height=0)
        self.assertEqual(status, 200, case)
        self.assertEqual(case["check"]["case"]["payload"]["mass_kg"], 2.4)
        subprocess.run([PROGRAM, "size", "--family=conical", "--mass=2.4", "--descent-rate=5", "--out", str(self.place / "sized.toml")], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual((self.folder / "sized.toml").read_text(), (self.place / "sized.toml").read_text())
        self.assertEqual(self.studio.post("/api/case/size", file="sized.toml", family="conical", mass=2.4, rate=5, speed=20, height=0)[0], 400)

    def test_options_of_a_run_are_no_way_to_other_options(self):
        for command in ("sweep", "stability", "load", "inflate", "fly", "recovery", "size"):
            for options in ({"--out": "x"}, {"--drogue": "../secret.toml"}, {"--drogue-steady": ".."}, {"--set": "a=b"}, {"--batch": "slurm"}, {"--fresh": True}, {"--steady": "../x"}):
                self.assertEqual(self.studio.post("/api/jobs/start", name="x", command=command, case="a.toml", options=options)[0], 400, (command, options))
        for options in ({"--out": "x"}, {"--hostfile": "x"}, {"--batch": "slurm"}, {"--set": "a=b"}, {"case": "x"}, {"": "x"}):
            status, answer = self.studio.post("/api/jobs/start", name="x", command="steady", case="a.toml", options=options)
            self.assertEqual(status, 400, options)
        self.assertEqual(self.studio.post("/api/jobs/start", name="x", command="report", case="a.toml", options={})[0], 400)
        self.assertEqual(self.studio.get("/api/jobs")[1], [])

    def wait_for(self, name, states):
        while time.monotonic() < DEADLINE:
            state = next(job["state"] for job in self.studio.get("/api/jobs")[1] if job["name"] == name)
            if state in states:
                return state
            time.sleep(0.1)
        return state

    def test_runs_are_those_of_the_command_line(self):
        s = self.studio
        (self.folder / "a.toml").write_text(CASE + '\n[coupling]\nload = "uniform"\nthreads = 1\nmax_iterations = 2\n')
        for name, command, options in (("a-load", "load", {"--mass": 2.4, "--speed": "20"}), ("a-recovery", "recovery", {"--mass": 2.4, "--apogee": 300, "--main-height": 100, "--drogue": "a.toml"}), ("a-steady", "steady", {"--grid": "20,20,30"}), ("a-sweep", "sweep", {"--speeds": "20", "--grid": "20,20,30", "--jobs": 1})):
            self.assertEqual(s.post("/api/jobs/start", name=name, command=command, case="a.toml", options=options)[0], 200)
        for name in ("a-load", "a-recovery"):
            self.assertEqual(self.wait_for(name, ["finished", "failed"]), "finished", s.get("/api/log", name=name))
        ends = ["finished", "not converged"]  # after two iterations
        for name in ("a-steady", "a-sweep"):
            self.assertIn(self.wait_for(name, [*ends, "failed"]), ends, s.get("/api/log", name=name))
        arguments = {"load": ["--mass", "2.4", "--speed", "20"], "recovery": ["--mass", "2.4", "--apogee", "300", "--main-height", "100", "--drogue", str(self.folder / "a.toml")], "steady": ["--grid", "20,20,30"]}
        for name, more in arguments.items():
            subprocess.run([PROGRAM, name, str(self.folder / "a.toml"), *more, "--out", str(self.place / name)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            own, printed = (json.loads((folder / "result.json").read_text()) for folder in (self.folder / f"runs/a-{name}", self.place / name))
            for result in (own, printed):
                for key in [key for key in result if "time_s" in key]:
                    del result[key]
            self.assertEqual(own, printed)
        progress = s.get("/api/progress", name="a-steady")[1]
        self.assertIn("forces", [plot["id"] for plot in progress["plots"]])
        self.assertGreater(progress["shape"]["frames"][0]["points"]["n"], 3000)
        self.assertNotIn("shape", s.get("/api/progress", name="a-steady", known=progress["shapeName"])[1])
        self.assertNotEqual(s.get("/api/progress", name="a-sweep")[1]["plots"], [])
        for name in ("a-load", "a-recovery"):
            self.assertEqual([plot["id"] for plot in s.get("/api/progress", name=name)[1]["plots"]], ["load", "speed", "height"], name)
        address = s.request("GET", "/api/report?run=a-steady&run=a-sweep")
        self.assertEqual(address[0], 200, address[2])
        page = s.request("GET", json.loads(address[2])["address"])[2].decode()
        self.assertIn("a-steady", page)
        self.assertIn("Comparison", page)
        self.assertEqual(s.get("/api/export", run="a-steady", format="report")[1]["text"], (self.folder / "runs/a-steady/report.html").read_text())
        self.assertEqual(s.get("/api/export", run="a-steady", format="toml")[1]["text"], (self.folder / "runs/a-steady/case.toml").read_text())

    def test_every_kind_of_run_starts_and_stops(self):
        s = self.studio
        (self.folder / "a.toml").write_text(CASE + "\n[inflation]\ninitial_radius_m = 0.1\n")
        runs = [("inflate", {"--pressure": 240, "--duration": 1, "--cloth-nodes": 500, "--air": "uniform"}), ("steady", {"--unsteady": True, "--grid": "20,20,30"}),
                ("fly", {"--mass": 2.4, "--duration": 1, "--cloth-nodes": 500, "--cells-across": 8}), ("stability", {"--angles": "0:10:10", "--grid": "20,20,30"}),
                ("sweep", {"--speeds": "10,20", "--grid": "20,20,30"}), ("size", {"--mass": 2.4, "--descent-rate": 5, "--family": "conical"})]
        for command, options in runs:
            name = f"a-{command}"
            self.assertEqual(s.post("/api/jobs/start", name=name, command=command, case="a.toml", options=options)[0], 200, command)
            ends = ["stopped", "finished", "not converged", "failed"]
            self.wait_for(name, ["running", *ends])
            while not s.get("/api/log", name=name)[1]["lines"] and self.wait_for(name, ["running", *ends]) == "running":
                time.sleep(0.1)
            self.assertEqual(s.post("/api/jobs/stop", name=name)[0], 200, command)
            self.assertIn(self.wait_for(name, ends), ends[:3], s.get("/api/log", name=name))

    def test_a_material_is_that_of_the_command_line(self):
        records = sorted((ROOT / "examples/fit-ripstop/records").glob("w*.csv"))
        request = {"bench": {"kind": "fabric", "name": "tested", "source": "</script> \" test", "areal_density_kg_m2": 0.0407, "thickness_m": 7.6e-5}, "cfm": 3, "coupons": False,
                   "records": [{"name": file.name, "base64": base64.b64encode(file.read_bytes()).decode()} for file in records]}
        status, answer = self.studio.post("/api/material", **request)
        self.assertEqual(status, 200, answer)
        self.assertEqual(len(answer["result"]["understood"]), 2 * len(records))
        self.assertEqual(list(answer["curves"]), [direction["name"] for direction in answer["result"]["directions"]])
        self.assertEqual(len(answer["curves"]["warp"]["fit"]), len(answer["curves"]["warp"]["spread"]))
        self.assertFalse((self.folder / "materials").exists())
        status, answer = self.studio.post("/api/material", save=True, **request)
        self.assertEqual((status, answer.get("saved")), (200, "materials/tested.toml"), answer)
        subprocess.run([PROGRAM, "fit", str(self.folder / "materials/tested/bench.toml"), "--no-coupons", "--out", str(self.place / "fit")], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.assertEqual((self.folder / "materials/tested.toml").read_text(), (self.place / "fit/tested.toml").read_text())
        before = self.read()
        status, after = self.studio.post("/api/case/change", file="a.toml", version=before["version"], changes={"parachute.canopy_material": "tested"})
        self.assertEqual((status, after["check"]["problems"]), (200, []), after["check"])
        status, answer = self.studio.post("/api/material", save=True, **request)
        self.assertEqual(status, 400)
        self.assertIn("exists already", answer["error"])

    def test_a_run_survives_the_kill_of_the_server(self):
        start = dict(name="steady", command="steady", case="a.toml", options={})
        self.assertEqual(self.studio.post("/api/jobs/start", **start)[0], 200)
        self.assertEqual(self.wait_for("steady", ["running"]), "running")
        with self.assertRaises(RuntimeError):  # a second server on the folder
            Studio(PROGRAM, self.folder)
        self.studio.end(signal.SIGKILL)
        self.studio = Studio.reopened(PROGRAM, self.folder)
        self.assertEqual(self.wait_for("steady", ["stopped"]), "stopped")
        self.assertEqual(self.studio.post("/api/jobs/resume", name="steady")[0], 200)
        self.assertEqual(self.wait_for("steady", ["running"]), "running")
        self.assertEqual(self.studio.post("/api/jobs/stop", name="steady")[0], 200)
        self.assertEqual(self.wait_for("steady", ["stopped"]), "stopped")

    def test_ctrl_c_ends_server_and_run(self):
        start = dict(name="steady", command="steady", case="a.toml", options={})
        self.assertEqual(self.studio.post("/api/jobs/start", **start)[0], 200)
        self.assertEqual(self.wait_for("steady", ["running"]), "running")
        self.assertEqual(self.studio.end(), 0)
        record = json.loads((self.folder / "runs/.studio/steady.json").read_text())
        self.assertEqual(record["state"], "stopped")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
