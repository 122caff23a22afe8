"""`ripstop studio` as a process, and requests to it."""
import http.client
import json
import pathlib
import signal
import subprocess
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIMIT = 600  # [s] of a request or an end, on a machine of any speed


class Studio:
    def __init__(self, program, folder, *arguments, before=None):
        """`before` is called in the new process."""
        self.process = subprocess.Popen([program, "studio", str(folder), "--no-browser", *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, preexec_fn=before)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            self.process.stdout.close()
            raise RuntimeError(f"no address, exit code {self.process.wait()}")
        parts = urllib.parse.urlsplit(self.address)
        self.port, self.token = parts.port, urllib.parse.parse_qs(parts.query)["token"][0]

    @classmethod
    def reopened(cls, program, folder):
        """Of a folder whose server was killed: once the system has ended its processes."""
        while True:
            try:
                return cls(program, folder)
            except RuntimeError:
                time.sleep(0.05)

    def request(self, method, path, body=None, headers=None, without=()):
        """Status, headers and bytes; `headers` replace those of the page, `without` names some to leave out."""
        all_headers = {"Host": f"127.0.0.1:{self.port}", "X-Ripstop-Token": self.token, **({"Content-Type": "application/json"} if method == "POST" else {}), **(headers or {})}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=LIMIT)
        connection.putrequest(method, path, skip_host=True)
        data = body if isinstance(body, bytes) else None if body is None else json.dumps(body).encode()
        if data is not None and "Content-Length" not in all_headers:
            all_headers["Content-Length"] = str(len(data))
        for name, value in all_headers.items():
            if name not in without:
                connection.putheader(name, value)
        connection.endheaders(data)
        answer = connection.getresponse()
        result = answer.status, answer.headers, answer.read()
        connection.close()
        return result

    def get(self, path, **parameters):
        status, _, body = self.request("GET", f"{path}?{urllib.parse.urlencode(parameters)}")
        return status, json.loads(body)

    def post(self, path, **body):
        status, _, answer = self.request("POST", path, body)
        return status, json.loads(answer)

    def shape(self, view="test", **parameters):
        """The shape in equilibrium, or the answer of a refusal."""
        status, answer = self.get("/api/shape", view=view, **parameters)
        while status == 200 and not answer["done"]:
            status, answer = self.get("/api/shape/later", view=view, number=answer["number"])
        return status, answer

    def memory(self):
        """Of the server [bytes]."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return 1024 * int(next(line.split()[1] for line in text.splitlines() if line.startswith("VmRSS")))

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        code = self.process.wait(LIMIT)
        self.process.stdout.close()
        return code
