// What HapticClient promises, against a server: test_client.exe CASE URL. Ends with code 0, or prints what is wrong.
using System;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using HL;

static class TestClient {
    const uint Name = 7;

    static void Expect(bool holds, string what) {
        if (!holds) throw new Exception("not so: " + what);
    }

    // For as long as it takes: the test's runner ends what hangs.
    static void WaitFor(Func<bool> holds) {
        while (!holds()) Thread.Sleep(2);
    }

    static string ReasonOf(HapticClient client) {
        client.Ended.Wait();
        Expect(client.Status == ClientStatus.Closed, "closed");
        Expect(!client.Reason.Contains("\n"), "one line: " + client.Reason);
        return client.Reason;
    }

    static TouchEvent Next(HapticClient client, params TouchEventKind[] kinds) {
        TouchEvent taken = null;
        WaitFor(() => client.Status == ClientStatus.Closed || client.Poll(out taken) && kinds.Contains(taken.Kind));
        Expect(client.Status != ClientStatus.Closed, "open: " + client.Reason);
        return taken;
    }

    // A level square of `side` metres, of cells * cells cells.
    static TouchMesh Floor(int cells, double side) {
        var vertices = new double[3 * (cells + 1) * (cells + 1)];
        for (int i = 0; i <= cells; ++i) {
            for (int j = 0; j <= cells; ++j) {
                vertices[3 * (i * (cells + 1) + j)] = side * (1.0 * i / cells - 0.5);
                vertices[3 * (i * (cells + 1) + j) + 2] = side * (1.0 * j / cells - 0.5);
            }
        }
        var triangles = new int[6 * cells * cells];
        for (int cell = 0; cell < cells * cells; ++cell) {
            int corner = cell / cells * (cells + 1) + cell % cells;
            int[] six = { corner, corner + 1, corner + cells + 1, corner + 1, corner + cells + 2, corner + cells + 1 };
            six.CopyTo(triangles, 6 * cell);
        }
        return new TouchMesh { Vertices = vertices, Triangles = triangles };
    }

    static void BadAddresses(string url) {
        foreach (string bad in new[] { "", "nonsense", "http://127.0.0.1", "hl://", "hl://127.0.0.1?speed=3" }) {
            bool refused = false;
            try {
                new HapticClient(bad);
            } catch (ArgumentException error) {
                refused = !error.Message.Contains("\n");
            }
            Expect(refused, "'" + bad + "' is refused");
        }
    }

    static void NobodyThere(string url) {
        var client = new HapticClient("hl://127.0.0.1:1");
        for (uint i = 1; i <= 1000; ++i) {
            client.Define(i, new TouchItem { Mesh = Floor(1, 0.1) });
            client.Flush();
        }
        string reason = ReasonOf(client);
        Expect(reason.StartsWith("cannot reach ws://127.0.0.1:1: "), reason);
        client.Flush();  // and so on, to no effect
        client.Dispose();
    }

    static void NoAnswer(string url) {
        var silent = new TcpListener(IPAddress.Loopback, 0);
        silent.Start();
        string where = "127.0.0.1:" + ((IPEndPoint)silent.LocalEndpoint).Port;
        var client = new HapticClient("hl://" + where, new ClientOptions { Timeout_s = 0.2 });
        string reason = ReasonOf(client);
        Expect(reason.StartsWith("no welcome from ws://" + where), reason);
        var given_up = new HapticClient("hl://" + where);
        given_up.Dispose();
        Expect(ReasonOf(given_up) == "closed by this program", given_up.Reason);
        silent.Stop();
    }

    // 40 000 vertices and 80 000 triangles go in parts; a simulated hand presses on them.
    static void LargeMeshIsFelt(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        client.Define(1, new TouchItem { Mesh = Floor(200, 0.2), Material = new TouchMaterial { StaticFriction = 0.3 } });
        client.SetWorld(new TouchItem { Object = 1, Name = Name });
        client.Set(new DeviceSettings { WorkspaceOrigin = new Vec3(0, 0, 0), HandGoal = new Vec3(0, 0.02, 0) });
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        Expect(client.Newest == null || client.Newest.Master, "master");
        WaitFor(() => client.Newest?.Finger.Y > 0.015);
        client.Set(new DeviceSettings { HandTurn = new Rotation(0, -3, 0, 3) });
        WaitFor(() => client.Newest.Stylus.HasValue && Math.Abs(client.Newest.Stylus.Value.Turned.Y + Math.Sqrt(0.5)) < 1e-3);
        Expect(Math.Abs(client.Newest.Stylus.Value.Turned.W - Math.Sqrt(0.5)) < 1e-3, "the stylus is turned");
        client.Set(new DeviceSettings { HandGoal = new Vec3(0, -0.02, 0) });
        WaitFor(() => client.Newest.Touched.Any(touched => touched.Name == Name && touched.Object == 1));
        Expect(Next(client, TouchEventKind.Touch).Name == Name, "the event's name");
        WaitFor(() => client.Newest.Force_N.Y > 0.3 && client.Newest.Touched.Length > 0);
        TouchState state = client.Newest;
        Expect(state.Proxy.Y > state.Finger.Y, "the proxy stays above the finger");
        Expect(Math.Abs(state.Touched[0].Normal.Y - 1) < 1e-9, "the normal is up");
        client.Dispose();
        ReasonOf(client);
    }

    // A hand presses on heights, on a cloud and on a volume, whose surface then rises under it.
    static void SurfacesThatAreNoMeshesAreFelt(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        const int side = 41;
        var heights = new short[side * side];
        var points = new double[3 * side * side];
        var colours = new byte[points.Length];
        var volume = new float[side * side * side];
        for (int i = 0; i < side * side; ++i) {
            points[3 * i] = 0.001 * (i % side - side / 2);
            points[3 * i + 2] = 0.001 * (i / side - side / 2);
        }
        for (int i = 0; i < volume.Length; ++i) volume[i] = 0.001f * (i / side % side - side / 2);  // y
        TouchItem[] items = {
            new TouchItem { Heights = new TouchHeights { Samples = heights, Columns = side, Spacing = 0.001 } },
            new TouchItem { Cloud = new TouchCloud { Points = points, Reach = 0.75, Colours = colours } },
            new TouchItem { Volume = new TouchVolume {
                Samples = volume, Width = side, Height = side, Spacing = 0.001, Iso = 0.0001, Below = true } }
        };
        client.SetWorld(new TouchItem { Object = 1 });
        client.Set(new DeviceSettings { WorkspaceOrigin = new Vec3(0, 0, 0), ProxyRadius = 0.002 });
        foreach (TouchItem item in items) {
            client.Set(new DeviceSettings { HandGoal = new Vec3(0, 0.02, 0) });
            WaitFor(() => client.Newest?.Finger.Y > 0.015);
            client.Define(1, item);
            client.Flush();
            Next(client, TouchEventKind.FrameShown);
            client.Set(new DeviceSettings { HandGoal = new Vec3(0, -0.005, 0) });
            WaitFor(() => client.Newest.Force_N.Y > 0.3 && client.Newest.Proxy.Y > 0.0015);
        }
        client.ChangeIso(1, 0, 0.0051);
        client.Flush();
        WaitFor(() => client.Newest.Proxy.Y > 0.0065);
        bool refused = false;
        try {
            client.Define(1, new TouchItem { Volume = new TouchVolume { Samples = new double[8], Width = 2, Height = 2 } });
        } catch (ArgumentException) {
            refused = true;
        }
        Expect(refused, "samples of double are refused");
        client.Dispose();
    }

    // Solids of each kind whose top is the origin: the proxy rests at its radius above it.
    static void ImplicitSurfacesAreFelt(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        var up = new Vec3(0, 1, 0);
        var across = new Vec3(1, 0, 0);
        Solid plate = Solid.Box(new Vec3(0.04, 0.01, 0.04)).At(0, -0.005, 0), ball = Solid.Sphere(0.01).At(0, -0.01, 0);
        Solid[] solids = {
            ball, plate, Solid.Box(new Vec3(0.02, 0.02, 0.02), 0.002).At(0, -0.01, 0),
            Solid.Cylinder(0.01, 0.02).Turned(across, 90).At(0, -0.01, 0),
            Solid.Capsule(0.005, 0.01).At(0, -0.01, 0).Turned(across, 90),
            Solid.Torus(0.02, 0.005).Turned(across, 90).At(0.02, -0.005, 0),
            Solid.Sphere(0.005).At(0, -0.01, 0).Scaled(2),
            Solid.Intersection(Solid.HalfSpace(up), Solid.Box(new Vec3(0.03, 0.03, 0.03))),
            Solid.Intersection(Solid.HalfSpace(up, 0.01), Solid.Box(new Vec3(0.03, 0.03, 0.03))).At(0, -0.01, 0),
            Solid.Difference(plate, Solid.Sphere(0.01).At(0, -0.018, 0)), Solid.SmoothUnion(0.0005, plate, ball),
            Solid.SmoothDifference(0.002, plate, Solid.Sphere(0.005).At(0.02, 0, 0)),
            Solid.SmoothIntersection(0.002, plate, Solid.Sphere(0.02).At(0, -0.01, 0)),
            Solid.Shell(Solid.Sphere(0.01), 0.002).At(0, -0.011, 0), Solid.Offset(Solid.Sphere(0.008), 0.002).At(0, -0.01, 0),
            Solid.Union(plate, Solid.Intersection(Solid.Gyroid(0.01, 0.002), ball))
        };
        client.SetWorld(new TouchItem { Object = 1 });
        client.Set(new DeviceSettings { WorkspaceOrigin = new Vec3(0, 0, 0), ProxyRadius = 0.002 });
        Action<TouchImplicit, string> press = (surface, which) => {
            client.Set(new DeviceSettings { HandGoal = new Vec3(0, 0.02, 0) });
            WaitFor(() => client.Newest?.Finger.Y > 0.015);
            client.Define(1, new TouchItem { Implicit = surface });
            client.Flush();
            Next(client, TouchEventKind.FrameShown);
            client.Set(new DeviceSettings { HandGoal = new Vec3(0, -0.003, 0) });
            WaitFor(() => client.Newest.Force_N.Y > 0.3);
            double top = client.Newest.Proxy.Y - 0.002;
            Expect(Math.Abs(top) < 2e-4, which + " is " + top + " m high");
            client.Define(1, new TouchItem { Implicit = new TouchImplicit { Solid = Solid.Sphere(0.01).At(0, -1, 0) } });
            client.Flush();
            Next(client, TouchEventKind.FrameShown);
        };
        for (int i = 0; i < solids.Length; ++i) press(new TouchImplicit { Solid = solids[i], Error = 2e-5 }, "solid " + i);
        press(new TouchImplicit {
            Solid = Solid.HalfSpace(up), Low = new Vec3(-0.02, -0.01, -0.02), High = new Vec3(0.02, 0.01, 0.02)
        }, "a half space");
        bool refused = false;
        try {
            client.Define(1, new TouchItem { Implicit = new TouchImplicit() });
        } catch (ArgumentException) {
            refused = true;
        }
        Expect(refused, "an implicit surface without a solid is refused");
        client.Dispose();
    }

    static void RefusedFrameChangesNothing(string url) {
        var client = new HapticClient(url);
        client.SetWorld(new TouchItem { Mesh = Floor(1, 0.1), Matrix = new double[16] });
        client.Flush();
        TouchEvent refused = Next(client, TouchEventKind.Refused);
        Expect(refused.Frame == 1 && refused.Text.Length > 10 && !refused.Text.Contains("\n"), refused.Text);
        client.SetWorld(new TouchItem { Mesh = Floor(1, 0.1) });
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        client.Dispose();
        ReasonOf(client);
    }

    static void TooLargeFrameIsRefusedHere(string url) {
        var client = new HapticClient(url);
        client.SetWorld(Enumerable.Range(0, 600).Select(i => new TouchItem { Mesh = Floor(16, 0.1) }).ToArray());
        client.Flush();
        Expect(Next(client, TouchEventKind.Refused).Text.Contains("several frames"), "the advice");
        client.SetWorld(new TouchItem { Mesh = Floor(16, 0.1) });
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        client.Dispose();
        ReasonOf(client);
    }

    // Far more frames than a server takes: they are put together, and none is refused.
    static void FastFramesAreMerged(string url) {
        var client = new HapticClient(url);
        WaitFor(() => client.Status == ClientStatus.Open);
        for (uint i = 1; i <= 20000; ++i) {
            client.Define(1 + i % 50, new TouchItem { Mesh = Floor(1, 0.1) });
            client.SetWorld(new TouchItem { Object = 1 + i % 50 });
            client.Flush();
        }
        client.Dispose();
        ReasonOf(client);
        TouchEvent taken;
        while (client.Poll(out taken)) Expect(taken.Kind != TouchEventKind.Refused, taken.Text);
    }

    // More settings than a server takes messages: of each kind the newest goes.
    static void FastSettingsAreMerged(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        client.SetWorld(new TouchItem { Mesh = Floor(1, 0.001) });
        client.Set(new DeviceSettings { WorkspaceOrigin = new Vec3(0, 1, 0), HandGoal = new Vec3(0, 1, 0) });
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        for (int i = 0; i <= 200000; ++i) {
            client.Set(new DeviceSettings { ProxyRadius = 0.003 });
            client.Set(new DeviceSettings { HandGoal = new Vec3(0, 1 + 1e-7 * i, 0) });
            if (i % 20 == 0) Thread.Sleep(0);
        }
        WaitFor(() => client.Status == ClientStatus.Closed || client.Newest.Finger.Y > 1.015);
        Expect(client.Status == ClientStatus.Open, "open: " + client.Reason);
        Expect(Math.Abs(client.Newest.ProxyRadius - 0.003) < 1e-12, "the radius");
        client.Dispose();
        ReasonOf(client);
    }

    static void SecondClientIsNotMaster(string url) {
        var first = new HapticClient(url);
        WaitFor(() => first.Status == ClientStatus.Open);
        var second = new HapticClient(url);
        second.Set(new DeviceSettings { ProxyRadius = 0.002 });
        Expect(Next(second, TouchEventKind.Refused).Text.Contains("master"), "it says why");
        WaitFor(() => second.Newest != null);
        Expect(!second.Newest.Master, "the state says so");
        first.Dispose();
        second.Dispose();
        ReasonOf(first);
        ReasonOf(second);
    }

    static void UnknownDeviceIsTold(string url) {
        string reason = ReasonOf(new HapticClient(url, new ClientOptions { DeviceLabel = "middle" }));
        Expect(reason.Contains("no device 'middle'; the server has 1"), reason);
    }

    static void WrongToken(string url) {
        string reason = ReasonOf(new HapticClient(url, new ClientOptions { Token = "wrong" }));
        Expect(reason.Contains("token"), reason);
    }

    static void RightToken(string url) {
        var client = new HapticClient(url + "?token=right%2dtoken-of-the-test");
        WaitFor(() => client.Status != ClientStatus.Connecting);
        Expect(client.Status == ClientStatus.Open, client.Reason);
        client.Dispose();
        ReasonOf(client);
    }

    // The runner stops the server when it reads "open".
    static void ServerGoesAway(string url) {
        var client = new HapticClient(url);
        WaitFor(() => client.Status == ClientStatus.Open);
        Console.WriteLine("open");
        string reason = ReasonOf(client);
        Expect(reason.Length > 0 && reason != "closed by this program", reason);
    }

    // A box of 20 mm, centred.
    static TouchMesh Box() {
        var vertices = new double[24];
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis) vertices[3 * corner + axis] = 0.02 * ((corner >> axis & 1) - 0.5);
        return new TouchMesh { Vertices = vertices, Triangles = new[] {
            0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 } };
    }

    static TouchItem At(uint id, double x, double y, uint? name = null) {
        return new TouchItem { Object = id, Name = name, Matrix = new[] { 1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1 } };
    }

    static BodyState BodyOf(HapticClient client, uint name) {
        WaitFor(() => client.Newest != null && client.Newest.Bodies.Any(body => body.Name == name));
        return client.Newest.Bodies.First(body => body.Name == name);
    }

    // A block falls on a floor and sleeps; another one, without gravity's help, goes where it is told.
    static void BodiesAnswer(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200, BodyEvents = true });
        client.Define(1, new TouchItem { Mesh = Floor(1, 0.4) });
        client.Define(2, new TouchObject {
            Items = new[] { new TouchItem { Mesh = Box() } },
            Body = new TouchBody { Mass_kg = 0.1, Shape = BodyShape.Box, Velocity_m_s = new Vec3(0, -0.5, 0) }
        });
        client.SetGravity(new Vec3(0, -5, 0));
        client.SetWorld(At(1, 0, 0), At(2, 0, 0.03, 8), At(2, 0.1, 0.011, 9));
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        Expect(Next(client, TouchEventKind.Impact).Impulse_N_s > 0.02, "the impulse");
        TouchEvent asleep = Next(client, TouchEventKind.Sleep);
        Expect(asleep.Object == 2 && asleep.Name >= 8, "who sleeps");
        WaitFor(() => Math.Abs(BodyOf(client, 8).Position.Y - 0.01) < 1e-3);
        client.SetGravity(new Vec3(0, 0, 0));
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        client.Place(2, new Vec3(0.1, 0.2, 0), new Rotation(0, 0, 1, 1), 9);
        client.SetVelocity(2, new Vec3(0, 0, 0), new Vec3(0, 0, 0), 9);
        client.Push(2, new Vec3(0, 0.02, 0), null, 0, 9);
        WaitFor(() => BodyOf(client, 9).Velocity_m_s.Y > 0.1);
        BodyState thrown = BodyOf(client, 9);
        Expect(Math.Abs(thrown.Velocity_m_s.Y - 0.2) < 1e-9, "an impulse over a mass: " + thrown.Velocity_m_s.Y);
        Expect(Math.Abs(thrown.Rotation.Z - Math.Sqrt(0.5)) < 1e-9, "it was turned");
        Expect(thrown.Position.Y > 0.2 && Math.Abs(thrown.Spin_rad_s.Z) < 1e-9, "where it flies");
        Expect(Math.Abs(BodyOf(client, 8).Position.Y - 0.01) < 1e-3, "the other one stays");
        client.Push(3, new Vec3(0, 1, 0));
        Expect(Next(client, TouchEventKind.Refused).Text.Length > 10, "no such body");
        client.Dispose();
        ReasonOf(client);
    }

    // A slider that a spring holds against gravity: m g / k below.
    static void JointsHold(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        client.Define(1, new TouchObject {
            Items = new[] { new TouchItem { Mesh = Box() } }, Body = new TouchBody { Mass_kg = 0.1, Shape = BodyShape.Box }
        });
        var slider = new TouchJoint { Id = 5, Kind = JointKind.Slider, ObjectA = 1, NameA = 8, Axis = new Vec3(0, 1, 0),
            Spring = 100, Damping = 4, Low = -0.05, High = 0.05 };
        var button = new TouchJoint { Id = 6, Kind = JointKind.Slider, ObjectA = 1, NameA = 9, Axis = new Vec3(0, 1, 0),
            Damping = 4, TablePositions = new[] { -0.02, 0.02 }, TableForces = new[] { 2.0, -2.0 } };
        client.SetGravity(new Vec3(0, -10, 0));
        client.SetWorld(new[] { slider, button }, At(1, 0, 0.1, 8), At(1, 0.1, 0.1, 9));
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        // It swings about its place first, so it is there only once it is slow, too.
        WaitFor(() => client.Newest != null && client.Newest.Joints.Length == 2 &&
            client.Newest.Joints.All(joint => Math.Abs(joint.Coordinate + 0.01) < 1e-6 && Math.Abs(joint.Velocity) < 1e-6));
        JointState held = client.Newest.Joints.Single(joint => joint.Id == 5);
        Expect(Math.Abs(held.Force - 1) < 1e-2, "the spring bears it: " + held.Force + " N");
        Expect(Math.Abs(BodyOf(client, 8).Position.Y - 0.09) < 2e-6, "where it hangs");
        client.SetWorld(new[] { new TouchJoint { Id = 7, Kind = JointKind.Ball, ObjectA = 3 } }, At(1, 0, 0.1, 8));
        client.Flush();
        Expect(Next(client, TouchEventKind.Refused).Text.Length > 10, "a joint without a body");
        client.Dispose();
        ReasonOf(client);
    }

    // The second snap of an object takes the finger; when it is gone, a field pushes.
    static void SnapsHoldAndFieldsPush(string url) {
        var client = new HapticClient(url, new ClientOptions { StateRate_Hz = 200 });
        var far = new TouchSnap { Points = new[] { 9.0, 0, 0 }, Normal = new Vec3(1, 0, 0), Capture = 0.001, Release_N = 1 };
        var near = new TouchSnap { Points = new[] { 0.0, 0, 0, 0.01, 0, 0 }, Capture = 0.004, Release_N = 5 };
        var wind = new TouchField { Kind = FieldKind.Constant, Points = new[] { 0.0, 0, 0 }, Reach = 0.05, Force_N = 0.3,
            Direction = new Vec3(0, 0, 1) };
        client.Define(1, new TouchObject { Snaps = new[] { far, near } });
        client.Define(2, new TouchObject { Fields = new[] { wind } });
        client.SetWorld(At(1, 0, 0, Name));
        client.Set(new DeviceSettings { WorkspaceOrigin = new Vec3(0, 0, 0), HandGoal = new Vec3(0, 0.002, 0) });
        client.Flush();
        Next(client, TouchEventKind.FrameShown);
        WaitFor(() => client.Newest?.Snap != null);
        HoldingSnap snap = client.Newest.Snap.Value;
        Expect(snap.Object == 1 && snap.Name == Name && snap.Number == 1, "which one holds");
        WaitFor(() => client.Newest.Snap.HasValue && Math.Abs(client.Newest.Proxy.Y) < 1e-6);
        client.SetWorld(At(2, 0, 0));
        client.Flush();
        WaitFor(() => {  // what the snap pulled fades out
            TouchState blown = client.Newest;
            return !blown.Snap.HasValue && blown.Force_N.Z > 0.2 && blown.Force_N.Z <= 0.3 + 1e-9;
        });
        bool refused = false;
        try {
            client.Define(3, new TouchObject { Snaps = new[] { new TouchSnap { Points = new[] { 1.0, 2 } } } });
        } catch (ArgumentException) {
            refused = true;
        }
        Expect(refused, "a point has three numbers");
        client.Dispose();
        ReasonOf(client);
    }

    static int Main(string[] arguments) {
        var cases = new Action<string>[] { BadAddresses, NobodyThere, NoAnswer, LargeMeshIsFelt, SurfacesThatAreNoMeshesAreFelt,
            ImplicitSurfacesAreFelt, RefusedFrameChangesNothing,
            TooLargeFrameIsRefusedHere, FastFramesAreMerged, FastSettingsAreMerged, SecondClientIsNotMaster,
            UnknownDeviceIsTold, WrongToken,
            RightToken, ServerGoesAway, BodiesAnswer, JointsHold, SnapsHoldAndFieldsPush };
        cases.Single(one => one.Method.Name == arguments[0])(arguments[1]);
        Console.WriteLine("passed");
        return 0;
    }
}
